// How much of a crack's energy lies beyond a distance, by the closed profiles of broken bars.

#include "mesh/generators/box_hexes.h"
#include "solver/fracture/words/coarse_cells.h"
#include "solver/fracture/words/resolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::this_file {
namespace {

TEST(Resolution, KnowsTheEnergyBeyondADistance) {
  for (const double s : {0.1, 0.5, 1.0, 1.5}) {
    EXPECT_NEAR(energy_beyond(crack_geometry("AT2"), s), std::exp(-2.0 * s), 2e-4);          // d = exp(-s)
    EXPECT_NEAR(energy_beyond(crack_geometry("AT1"), s), std::pow(1.0 - 0.5 * s, 3), 2e-4);  // d = (1 - s/2)^2
    const double within = (s + 0.5 * std::sin(2.0 * s)) * 2.0 / std::numbers::pi;            // d = 1 - sin(s)
    EXPECT_NEAR(energy_beyond(crack_geometry("Wu"), s), 1.0 - within, 2e-4);
  }
  EXPECT_EQ(energy_beyond(crack_geometry("AT1"), 2.5), 0.0);
}

struct Box {
  Mesh mesh;
  FractureModel model;
};

/// By AT2 with ell = 0.3 m.
Box box_that_may_crack(std::array<std::vector<AxisBlock>, 3> axes) {
  BoxHexesSettings settings;
  settings.axes = std::move(axes);
  Box box{.mesh = make_box_hexes(settings), .model = {}};
  box.model.crack = &crack_geometry("AT2");
  box.model.regions.resize(1);
  box.model.regions[0].ell = 0.3;
  return box;
}

/// Rows of cells along x, 0.1, 0.1 and 0.5 m thick, 1 m across; ell is 0.3 m.
TEST(Resolution, TellsOfACrackThatEntersCoarseCells) {
  const auto [mesh, model] = box_that_may_crack({{{{0.2, 2, 1.0}, {0.5, 1, 1.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}});
  const ResolutionWords words = resolution_words(mesh, model, {}, true);
  EXPECT_TRUE(words.warnings.empty());
  ASSERT_EQ(words.remarks.size(), 1u);
  EXPECT_NE(words.remarks[0].find("a crack is resolved in 2 of 3 cells (at most ell/2)"), std::string::npos)
      << words.remarks[0];
  CoarseCells coarse(mesh, model);
  CellField<double> damage(mesh.n_cells(), 0.4);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() < 0.2) damage[c] = 1.0;
  EXPECT_TRUE(coarse.look(damage).empty());
  for (Index c = 0; c < mesh.n_cells(); ++c) damage[c] = 0.6;
  const std::vector<std::string> warnings = coarse.look(damage);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("a crack has entered cells that do not resolve it, 500 mm thick at (450, 500, 500) mm"),
            std::string::npos)
      << warnings[0];
  EXPECT_TRUE(coarse.look(damage).empty());  // said once
}

/// Cells thin in y and 0.5 m long along x; ell is 0.3 m. Their thickness alone does not tell of a crack across x.
TEST(Resolution, TellsOfACrackAcrossLongCells) {
  auto [mesh, model] = box_that_may_crack({{{{1.5, 3, 1.0}}, {{0.2, 2, 1.0}}, {{0.1, 1, 1.0}}}});
  const ResolutionWords words = resolution_words(mesh, model, {}, true);
  EXPECT_TRUE(words.warnings.empty());
  ASSERT_EQ(words.remarks.size(), 1u);
  EXPECT_NE(words.remarks[0].find("cells are 500 mm long or longer in their plane, ell is 300 mm"), std::string::npos);
  CellField<double> damage(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() < 0.5) damage[c] = 0.55;  // no steeper than 1/ell
  CoarseCells coarse(mesh, model);
  EXPECT_TRUE(coarse.look(damage).empty());
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() < 0.5) damage[c] = 0.95;
  const std::vector<std::string> warnings = coarse.look(damage);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the damage changes by 0.95 from a cell to the next, 500 mm apart"), std::string::npos)
      << warnings[0];
  EXPECT_TRUE(coarse.look(damage).empty());  // said once
  CoarseCells beside_glass(mesh, model);
  model.regions[0].damageable = false;
  EXPECT_TRUE(beside_glass.look(damage).empty());
}

/// A plane band one cell wide in z, 0.2 m thick in y, of columns whose lengths along x are given; ell is 100 mm.
struct PlaneBand {
  Mesh mesh;
  FractureModel model;
  std::vector<Band> bands{{.region = "body", .width = 0.2, .neighbours = {}}};

  explicit PlaneBand(std::vector<AxisBlock> columns) {
    BoxHexesSettings box;
    box.axes = {{std::move(columns), {{0.2, 4, 1.0}}, {{3.0, 1, 1.0}}}};
    mesh = make_box_hexes(box);
    model.regions.resize(1);
    model.regions[0].ell = 0.1;
    model.regions[0].elasticity = from_young_poisson(1e6, 0.4);
    law("AT1", degradation("quadratic"));
  }
  void law(const char* crack, const Degradation& g) {
    model.crack = &crack_geometry(crack);
    model.degradation = g;
  }
  ResolutionWords words() const { return resolution_words(mesh, model, bands, true); }
};

bool warns_of_width(const ResolutionWords& words) {
  return std::ranges::any_of(words.warnings, [](const std::string& w) { return w.find("wide along") != w.npos; });
}

// A column along the band has the length of its cells, however wide the mesh is in z.
TEST(Resolution, HoldsCellsAlongABandAgainstEll) {
  EXPECT_TRUE(warns_of_width(PlaneBand({{1.0, 7, 1.0}}).words()));
  EXPECT_FALSE(warns_of_width(PlaneBand({{1.0, 10, 1.0}}).words()));
}

// E Gc/((1 - nu^2) ft^2) is 0.2 m with 1.68e4 J/m^2 and 316 kPa, 0.05 m with twice that strength.
TEST(Resolution, HoldsCellsAlongABandWithSofteningAgainstTheProcessZone) {
  PlaneBand band({{1.4, 7, 1.0}});
  const SofteningLaw& linear = softening_law("linear");
  const double E = 1e6, Gc = 0.2 * (1.0 - 0.16) * 1e11 / E;
  band.law("Wu", rational_degradation(rational_coefficients(linear, E, Gc, std::sqrt(1e11), 0.1)));
  EXPECT_FALSE(warns_of_width(band.words()));
  band.law("Wu", rational_degradation(rational_coefficients(linear, E, Gc, std::sqrt(4e11), 0.1)));
  const ResolutionWords words = band.words();
  EXPECT_TRUE(warns_of_width(words));
  EXPECT_NE(words.warnings[0].find("ell is 100 mm"), std::string::npos) << words.warnings[0];
}

TEST(Resolution, RemarksOnABandThatIsFineWhereItsCrackGrows) {
  const ResolutionWords words = PlaneBand({{1.0, 10, 1.0}, {9.0, 15, 1.0}}).words();
  EXPECT_FALSE(warns_of_width(words));
  ASSERT_EQ(words.remarks.size(), 1u);
  EXPECT_NE(words.remarks[0].find("is resolved in 40 of 100 cells"), std::string::npos) << words.remarks[0];
}

/// Two regions of 20 x 8 cells of 0.1 m; ell is 0.3 m.
TEST(Resolution, RemarksOnceOnDirectionsAndNamesWhatTheModelAllows) {
  BoxHexesSettings box;
  box.axes = {{{{2.0, 20, 1.0}}, {{1.6, 16, 1.0}}, {{0.1, 1, 1.0}}}};
  box.regions = {{.name = "upper", .lower = {-1.0, 0.8, -1.0}, .upper = {3.0, 2.0, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  FractureModel model;
  model.crack = &crack_geometry("AT1");
  model.split = energy_split("none");
  model.regions.resize(2);
  for (RegionModel& region : model.regions) region.ell = 0.3;
  const std::string remark = direction_remark(mesh, model);
  EXPECT_TRUE(remark.starts_with("regions \"body\", \"upper\": ")) << remark;
  EXPECT_NE(remark.find("(ell/h = 3)"), std::string::npos) << remark;
  EXPECT_NE(remark.find("stiffness_damage"), std::string::npos) << remark;
  model.irreversibility = Irreversibility::history;  // not with the mean damage
  EXPECT_EQ(direction_remark(mesh, model).find("stiffness_damage"), std::string::npos);
  model.irreversibility = Irreversibility::bounds;
  model.stiffness_by = StiffnessBy::mean;
  EXPECT_NE(direction_remark(mesh, model).find("also with fracture.stiffness_damage"), std::string::npos);
}

}  // namespace
}  // namespace pfdm::this_file
