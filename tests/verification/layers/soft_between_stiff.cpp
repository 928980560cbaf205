// A gel between steel plates that are moved: residuals are relative to the forces that would move the plates alone, and
// tolerances follow the forces that act.

#include "mesh/generators/box_hexes.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::soft_between_stiff {
namespace {

constexpr double stretch = 0.1, area = 16e-6;  // of the gel; [m^2]

Mesh layers() {
  BoxHexesSettings box;
  box.axes = {{{{4e-3, 4, 1.0}}, {{4e-3, 4, 1.0}}, {{1e-3, 2, 1.0}, {10e-3, 5, 1.0}, {1e-3, 2, 1.0}}}};
  box.base_region = "steel";
  box.regions = {{.name = "gel", .lower = {-1.0, -1.0, 1e-3}, .upper = {1.0, 1.0, 11e-3}}};
  return make_box_hexes(box);
}

/// 4 x 4 x 10 mm of a gel, sheared by 0.3 mm and pulled by 1 mm.
struct ShearedGel {
  Mesh mesh = layers();
  FractureModel model;

  explicit ShearedGel(double modulus) {
    std::vector<IsotropicElasticity> by_region;
    for (const std::string& name : mesh.region_names)
      by_region.push_back(from_young_poisson(name == "gel" ? modulus : 200e9, 0.0));
    const auto held = [](const Vector&) -> Vector { return Vector::Zero(); };
    const auto moved_by = [](const Vector&, double t) -> Vector { return t * Vector(0.3e-3, 0.0, 1e-3); };
    model = elastic_model(by_region, {displacement_on("zmin", held), moved("zmax", {true, true, true}, moved_by)});
  }
  FractureRun run() const {
    return {mesh, model, {}, {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}}};
  }
};

TEST(SoftBetweenStiff, BalanceTheForcesThatAct) {
  for (const double modulus : {1e6, 1e4, 1e2}) {
    const ShearedGel gel(modulus);
    FractureRun run = gel.run();
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      if (report.step == 0) return;
      const Vector held = report.reaction[gel.mesh.patch_index("zmin")];
      const Vector moved_side = report.reaction[gel.mesh.patch_index("zmax")];
      const double along = moved_side.z() / (modulus * area * stretch * report.load);
      report_row(fmt::format("{} Pa, load {}", modulus, report.load),
                 {{"along", along}, {"across", -moved_side.x() / held.x()}});
      EXPECT_NEAR(along, 1.0, 1e-3);
      EXPECT_NEAR(-held.z() / moved_side.z(), 1.0, 1e-3);
      EXPECT_NEAR(-held.x() / moved_side.x(), 1.0, 5e-3);  // the sum of all that is left is 1e-3 of the force along
      EXPECT_THAT(report.remarks, testing::IsEmpty());
    });
  }
}

// Warmed freely no force acts and what is left is rounding or tolerance: nothing is told of it, and it does not keep
// the tolerances from following the forces once the body is pulled.
TEST(SoftBetweenStiff, BalanceTheForcesThatActAfterTheBodyHasWarmedFreely) {
  constexpr double expansion = 1e-5, warmth = 100.0, height = 12e-3;  // [1/K], [K], [m]
  for (const double modulus : {200e9, 1e5, 1e2}) {
    ShearedGel gel(modulus);
    FractureModel& model = gel.model;
    const auto warmed = [](double t) { return warmth * std::min(2.0 * t, 1.0); };
    const auto pulled = [&](const Vector&, double t) -> Vector {
      return {0.0, 0.0, expansion * warmed(t) * height + std::max(t - 0.5, 0.0) * 2e-3};
    };
    model.boundary = {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
                      moved("zmax", {false, false, true}, pulled)};
    for (auto& region : model.regions) region.expansion = expansion * Tensor::Identity();
    model.loads.temperature = [&](const Vector&, double t) { return warmed(t); };
    FractureRun run = gel.run();
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      EXPECT_THAT(report.remarks, testing::IsEmpty());
      if (report.load < 0.6) return;
      const Vector held = report.reaction[gel.mesh.patch_index("zmin")];
      const Vector moved_side = report.reaction[gel.mesh.patch_index("zmax")];
      const double compliance = (10e-3 / modulus + 2e-3 / 200e9) / area;  // of bars without lateral strain
      const double along = moved_side.z() * compliance / ((report.load - 0.5) * 2e-3);
      report_row(fmt::format("{} Pa, load {}", modulus, report.load), {{"along", along}});
      EXPECT_NEAR(along, 1.0, 1e-3);
      EXPECT_NEAR(-held.z() / moved_side.z(), 1.0, 1e-3);
    });
  }
}

// Rounding of the forces in the steel is more than the gel bears.
TEST(SoftBetweenStiff, AreToldOfWhereNoToleranceHelps) {
  const ShearedGel gel(1e-6);
  FractureRun run = gel.run();
  FractureState state = run.initial_state();
  const StepReport report = run.step(state);
  EXPECT_THAT(report.remarks, testing::Contains(testing::HasSubstr("out of balance")));
  EXPECT_LT(report.reaction[gel.mesh.patch_index("zmax")].norm(), 1e-6);  // [N]; of rounding alone
}

TEST(SoftBetweenStiff, GoOnFromAStateWithTheSameBits) {
  const ShearedGel gel(1e4);
  FractureRun run = gel.run(), again = gel.run();
  std::vector<FractureState> states;
  run_to_end(run, [&](const FractureState& state, const StepReport&) { states.push_back(state); });
  ASSERT_EQ(states.size(), 5u);
  const FractureState end = run_to_end(again, states[2], [](const FractureState&, const StepReport&) {});
  EXPECT_EQ(end.displacement, states.back().displacement);
  EXPECT_EQ(end.balance.tightening, states.back().balance.tightening);
  EXPECT_LT(end.balance.tightening, 1.0);
}

}  // namespace
}  // namespace pfdm::verification::soft_between_stiff
