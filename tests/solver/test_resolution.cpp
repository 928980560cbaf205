// How much of a crack's energy lies beyond a distance, by the closed profiles of broken bars.

#include "mesh/generators/box_hexes.h"
#include "solver/fracture/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm {
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

/// Rows of cells along x, 0.1, 0.1 and 0.5 m thick, 1 m across; ell is 0.3 m.
TEST(Resolution, TellsOfACrackThatEntersCoarseCells) {
  BoxHexesSettings box;
  box.axes = {{{{0.2, 2, 1.0}, {0.5, 1, 1.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(box);
  FractureModel model;
  model.crack = &crack_geometry("AT2");
  model.regions.resize(1);
  model.regions[0].ell = 0.3;
  const ResolutionWords words = resolution_words(mesh, model, {}, true);
  EXPECT_TRUE(words.warnings.empty());
  ASSERT_EQ(words.remarks.size(), 1u);
  EXPECT_NE(words.remarks[0].find("a crack is resolved in 2 of 3 cells (at most ell/2)"), std::string::npos)
      << words.remarks[0];
  CoarseCells coarse(mesh, model);
  CellField<double> damage(as_size(mesh.n_cells()), 0.4);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() < 0.2) damage[c] = 1.0;
  EXPECT_TRUE(coarse.look(damage).empty());
  for (Index c = 0; c < mesh.n_cells(); ++c) damage[c] = 0.6;
  const std::vector<std::string> warnings = coarse.look(damage);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("a crack has entered cells that do not resolve it, 0.5 m thick at (0.45, 0.5, 0.5) m"),
            std::string::npos)
      << warnings[0];
  EXPECT_TRUE(coarse.look(damage).empty());  // said once
}

}  // namespace
}  // namespace pfdm
