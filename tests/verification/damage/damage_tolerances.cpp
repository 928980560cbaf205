// A bead that debonds, with the two criteria for the damage: the largest change of a cell, and the relative change in
// the norm L2.

#include "solver/fracture/fracture_run.h"
#include "tests/verification/bead.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

struct Outcome {
  std::vector<double> forces;  // of the top, by step [N]
  CellField<double> damage;    // at the end
  Index iterations = 0;
};

Outcome debond(const Mesh& mesh, const StaggeredSettings& settings) {
  FractureRun run(mesh, bead_model(mesh, "volumetric_deviatoric", 0.3), settings,
                  {.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
  const auto top = mesh.patch_index("zmax");
  Outcome outcome;
  const FractureState end = run_to_end(
      run, [&](const FractureState&, const StepReport& report) { outcome.forces.push_back(report.reaction[top].z()); });
  outcome.damage = end.damage;
  outcome.iterations = run.staggered_iterations();
  return outcome;
}

double difference_in_l2(const Mesh& mesh, const CellField<double>& a, const CellField<double>& b) {
  double difference = 0.0, all = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    difference += mesh.cell_volume[c] * (a[c] - b[c]) * (a[c] - b[c]);
    all += mesh.cell_volume[c] * b[c] * b[c];
  }
  return std::sqrt(difference / all);
}

// The largest change is given a tolerance that no step meets: every step ends by the other one.
TEST(DamageTolerances, OfTheNormL2Suffices) {
  const Mesh mesh = sphere_in_cube(4, 5, 2.5, 0.4);
  const Outcome exact = debond(mesh, {.damage_tolerance = 1e-4});
  const Outcome outcome = debond(mesh, {.damage_tolerance = 1e-15, .damage_tolerance_l2 = 1e-3});
  ASSERT_EQ(outcome.forces.size(), exact.forces.size());  // no increment was cut
  double force = 0.0;
  for (std::size_t k = 1; k < exact.forces.size(); ++k)
    force = std::max(force, std::abs(outcome.forces[k] / exact.forces[k] - 1.0));
  const double damage = difference_in_l2(mesh, outcome.damage, exact.damage);
  report_row("L2 0.001", {{"largest difference of a force", force},
                          {"difference of the damage, L2", damage},
                          {"iterations", double(outcome.iterations)},
                          {"with the largest change 1e-4", double(exact.iterations)}});
  EXPECT_LE(force, 5e-4);
  EXPECT_LE(damage, 0.03);
  EXPECT_LE(double(outcome.iterations), 0.7 * double(exact.iterations));
}

}  // namespace
}  // namespace pfdm::verification::this_file
