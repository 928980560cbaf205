// What is said of a step that did not converge: the criteria that do not hold, and what else may help.

#include "mesh/generators/box_hexes.h"
#include "solver/fracture/unconverged.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Three cells along x with centres at 1, 3 and 5 m.
Mesh three_cells() {
  BoxHexesSettings box;
  box.axes = {{{{6.0, 3, 1.0}}, {{2.0, 1, 1.0}}, {{2.0, 1, 1.0}}}};
  return make_box_hexes(box);
}

/// A step whose damage, energy and residual miss their tolerances tenfold.
StepOutcome restless(Index cell) {
  StepOutcome outcome;
  outcome.rest.cell = cell;
  outcome.rest.damage = 1e-3;
  outcome.rest.energy = 2e-3;
  outcome.residual = 3e-5;
  return outcome;
}

TEST(Unconverged, NamesCellChangeAndResidual) {
  const Mesh mesh = three_cells();
  const StaggeredSettings settings;
  for (const Index cell : {Index{0}, Index{2}}) {
    const std::string words = what_changes(mesh, settings, restless(cell));
    const double x = mesh.cell_centre[cell].x();
    EXPECT_THAT(words, HasSubstr("the damage of cell " + std::to_string(cell) + " at (" + (x < 2.0 ? "1" : "5") +
                                 ", 1, 1) m changes by 1.0e-03 an iteration (solver.damage_tolerance = 0.0001)"));
    EXPECT_THAT(words, HasSubstr("the energy changes by 2.0e-03 of it (solver.energy_tolerance = 0.0001)"));
    EXPECT_THAT(words, HasSubstr("the residual of the momentum balance is 3.0e-05 (solver.equilibrium_tolerance = "
                                 "1e-06)"));
  }
}

TEST(Unconverged, NamesNoCriterionThatHolds) {
  const Mesh mesh = three_cells();
  StaggeredSettings settings;
  settings.damage_tolerance = 2e-3;
  settings.equilibrium_tolerance = 1e-4;
  const std::string words = what_changes(mesh, settings, restless(1));
  EXPECT_EQ(words, "the energy changes by 2.0e-03 of it (solver.energy_tolerance = 0.0001)");
  StepOutcome settled = restless(1);
  settled.settled = true;  // by the norm L2 of the damage, whatever single cells do
  EXPECT_THAT(what_changes(mesh, StaggeredSettings{}, settled), Not(HasSubstr("the damage of cell")));
}

TEST(Unconverged, AdvisesByTheWayInWhichItFailed) {
  StaggeredSettings settings;
  settings.maximum_iterations = 7;
  StepOutcome outcome = restless(1);
  EXPECT_EQ(what_to_try(settings, outcome, {}), "may help: solver.maximum_iterations above 7");
  outcome.circles = true;
  EXPECT_THAT(what_to_try(settings, outcome, {}),
              HasSubstr("more iterations do not help, they go in circles; may help: smaller cells"));
  outcome.circles = false;
  outcome.settled = true;
  EXPECT_THAT(what_to_try(settings, outcome, {}), HasSubstr("a larger solver.equilibrium_tolerance accepts it"));
  outcome.settled = false;
  outcome.failed = true;
  EXPECT_EQ(what_to_try(settings, outcome, {.viscosity = true, .dissipation_control = true}),
            "may help: a smaller loading.minimum_increment, fracture.viscosity, loading.maximum_dissipation");
}

TEST(Unconverged, NamesCellsWhereTheLinearSolverIsStuck) {
  StepOutcome outcome = restless(1);
  outcome.failed = outcome.stuck = outcome.settled = true;
  EXPECT_EQ(what_changes(three_cells(), {}, outcome), "the linear solver came no closer to balance (residual 3.0e-05)");
  EXPECT_THAT(what_to_try({}, outcome, {}), HasSubstr("solver.linear = \"direct\", better cells"));
  EXPECT_THAT(what_to_try({.linear = &linear_solver("direct")}, outcome, {}),
              HasSubstr("may help: better cells (pfdm mesh)"));
}

}  // namespace
}  // namespace pfdm::this_file
