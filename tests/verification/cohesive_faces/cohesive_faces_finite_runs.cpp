// Cohesive faces at finite strain in runs: the limit of small strain, a sphere in rubber, steps that are cut where a
// bond gives way, runs that go on.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/finite_blocks.h"
#include "tests/verification/noise.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::finite_blocks;

constexpr InterfaceStrength weak{.strength = 0.2, .toughness = 8e-8, .stiffness = 1e8};

FractureModel weakly_bonded_sphere(const Mesh& mesh, double pull) {
  FractureModel model =
      elastic_model({}, {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                         moved("zmax", {false, false, true},
                               [pull](const Vector&, double t) -> Vector { return pull * t * Vector::UnitZ(); })});
  for (const std::string& name : mesh.region_names)
    model.regions.push_back(
        {.elasticity = name == "bead" ? from_young_poisson(2e9, 0.3) : from_young_poisson(2e6, 0.48),
         .damageable = false});
  glue(model, mesh, law_of(linear_law()), weak, Vector::UnitZ(), [](const Vector&) { return false; });
  CohesiveSurface& surface = model.interfaces[0];
  const Index bead = mesh.region_index("bead");
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    if ((mesh.region[mesh.owner[f]] == bead) == (mesh.region[mesh.neighbour[f]] == bead)) continue;
    surface.faces.push_back(f);
    surface.sign.push_back(1.0);
    surface.at.push_back(weak);
  }
  return model;
}

struct End {
  StepReport report;
  OutputInterface interface;
};

End end_of(const Mesh& mesh, const FractureModel& model) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-9},
                  {.initial_increment = 0.2, .maximum_increment = 0.2, .stops = {}});
  End end;
  const FractureState last =
      run_to_end(run, [&](const FractureState&, const StepReport& report) { end.report = report; });
  end.interface = run.output(last).interfaces[0];
  return end;
}

// A stiff sphere in rubber that is drawn until its poles soften (without a jump), at a nominal strain of 1e-7: with and
// without finite strain.
TEST(FiniteFaces, AreThoseOfSmallStrainWhereItIsSmall) {
  constexpr double strain = 1e-7, half_width = 2.0;
  const Mesh mesh = sphere_in_cube(2, 2, half_width, 0.5);
  FractureModel model = weakly_bonded_sphere(mesh, 2.0 * half_width * strain);
  const End small = end_of(mesh, model);
  make_finite(model);
  const End large = end_of(mesh, model);
  const std::size_t top = mesh.patch_index("zmax");
  const double force = large.report.reaction[top].z() / small.report.reaction[top].z() - 1.0;
  const double dissipated = large.report.energy.interface_dissipation / small.report.energy.interface_dissipation - 1.0;
  double wrong = 0.0, most = 0.0;
  for (Index k = 0; k < small.interface.opening.size(); ++k) {
    wrong = std::max(wrong, (large.interface.separation[k] - small.interface.separation[k]).norm());
    most = std::max(most, small.interface.separation[k].norm());
  }
  report_row("sphere at small strain", {{"force", force},
                                        {"dissipated", dissipated},
                                        {"separation", wrong / most},
                                        {"largest / (Gc/strength)", most * weak.strength / weak.toughness}});
  EXPECT_GT(small.report.energy.interface_dissipation, 0.0);
  EXPECT_NEAR(force, 0.0, 1e-6);
  EXPECT_NEAR(dissipated, 0.0, 1e-6);
  EXPECT_LT(wrong, 1e-6 * most);
}

// A bar between sliding sides whose end moves by `drawn` [m].
std::vector<BoundaryCondition> drawn_out(double drawn) {
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, false, false}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
      moved("xmax", {true, false, false},
            [drawn](const Vector&, double t) -> Vector { return drawn * t * Vector::UnitX(); })};
  for (const char* side : {"ymin", "ymax", "zmin", "zmax"}) boundary.push_back(symmetry_on(side));
  return boundary;
}

LoadingSettings in_thirds(double energy_release) {
  return {.initial_increment = 1.0 / 3.0,
          .maximum_increment = 1.0 / 3.0,
          .energy_release = energy_release,
          .finest_increment = 1e-2,
          .stops = {}};
}

// Steps of the sliding bar of above, drawn to a stretch of 1.9 and pressed to 0.55, with a limit on what is released.
// Its energy does not grow with the load squared; only a bond that gives way cuts the steps.
class FiniteReleases : public testing::TestWithParam<double> {};

TEST_P(FiniteReleases, AreOfBondsThatGiveWay) {
  const Mesh mesh = two_blocks(2);
  InterfaceStrength at = bond;
  for (const double held : {100.0, 1.0}) {
    at.strength = held * bond.strength, at.toughness = held * bond.toughness;
    FractureModel model = elastic_model(std::vector(mesh.region_names.size(), rubber), {});
    glue(model, mesh, law_of(linear_law()), at, Vector::UnitX(),
         [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
    make_finite(model);
    const double drawn = 2.0 * edge * GetParam();
    model.boundary = drawn_out(drawn);
    FractureRun run(mesh, model, {}, in_thirds(0.02));
    double dissipated = 0.0, largest = 0.0;
    StepReport last;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      if (report.energy.interface_dissipation > dissipated + 1e-12) largest = std::max(largest, report.increment);
      dissipated = report.energy.interface_dissipation;
      last = report;
    });
    report_row(fmt::format("stretch {}, bond times {}", 1.0 + GetParam(), held),
               {{"steps", double(last.step)}, {"largest that dissipates", largest}, {"dissipated", dissipated}});
    const bool gives_way = held == 1.0 && GetParam() > 0.0;
    EXPECT_EQ(dissipated > 1e-12, gives_way);
    if (!gives_way)
      EXPECT_EQ(last.step, 3);
    else
      EXPECT_LT(largest, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Drawn, FiniteReleases, testing::Values(0.9, -0.45),
                         [](const auto& test) { return std::string(test.param > 0.0 ? "out" : "together"); });

// The bond is half of the section, gives way at a stretch between 1.1 and 1.2, and takes a hundredth of what is stored:
// what it releases besides, most of it into nothing, has to cut the steps.
TEST(FiniteFaces, ABondThatSnapsBesideABodyThatStaysStretchedCutsTheSteps) {
  const Mesh mesh = two_blocks(2);
  InterfaceStrength at = bond;
  at.strength = 4e5, at.toughness = 1.0, at.stiffness = 2e12;
  FractureModel model = elastic_model(std::vector(mesh.region_names.size(), rubber), {});
  glue(model, mesh, law_of(linear_law()), at, Vector::UnitX(),
       [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9 && x.y() < 0.5 * edge; });
  make_finite(model);
  const double drawn = 0.3 * 2.0 * edge;
  model.boundary = drawn_out(drawn);
  FractureRun run(mesh, model, {}, in_thirds(0.03));
  double largest = 0.0, released = 0.0, torn = 0.0;
  StepReport before;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.energy.interface_dissipation > before.energy.interface_dissipation + 1e-12) {
      largest = std::max(largest, report.increment);
      released = std::max(released, 1.0 - report.energy.elastic / before.energy.elastic);
      torn = std::max(torn, report.energy.interface_dissipation / before.energy.elastic);
    }
    before = report;
  });
  report_row("half a bond", {{"steps", double(before.step)},
                             {"largest that dissipates", largest},
                             {"share released", released},
                             {"share torn", torn}});
  EXPECT_LT(torn, 0.03);
  EXPECT_LE(largest, 1.01e-2);
}

// A run goes on from a state with open faces as the one that came there.
TEST(FiniteFaces, GoOnFromAState) {
  const Mesh mesh = two_blocks(2);
  FractureModel model = bonded_blocks(mesh, law_of(linear_law()), rubber);
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {true, true, true},
                          [](const Vector&, double t) -> Vector { return edge * t * Vector(0.6, 0.4, 0.1); })};
  const LoadingSettings loading{
      .end = 4.0, .initial_increment = 1.0, .minimum_increment = 1.0, .maximum_increment = 1.0, .stops = {}};
  FractureRun run(mesh, model, {}, loading);
  FractureState midway;
  StepReport last;
  const FractureState end = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (state.step == 2) midway = state;
    last = report;
  });
  FractureRun other(mesh, model, {}, loading);
  const FractureState again = advance_to_end(other, midway, [](const FractureState&, const StepReport&) {});
  EXPECT_GT(last.energy.interface_dissipation, 0.0);
  EXPECT_EQ(again.displacement, end.displacement);
  EXPECT_EQ(again.interfaces, end.interfaces);
}

}  // namespace
}  // namespace pfdm::verification::this_file
