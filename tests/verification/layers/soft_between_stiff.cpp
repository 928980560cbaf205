// A gel between steel plates that are moved: equilibrium is relative to the forces that would move the plates alone,
// and a run tells where that is not enough.

#include "mesh/generators/box_hexes.h"
#include "tests/verification/support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pfdm::verification::soft_between_stiff {
namespace {

struct Sheared {
  double force = 0.0;  // on the side that is held [N]
  double moved = 0.0;  // on the side that is moved [N]
  std::string remarks;
};

// 4 x 4 x 10 mm of a gel of 10 kPa, sheared by 0.3 mm and pulled by 1 mm.
Sheared shear(double tolerance) {
  BoxHexesSettings box;
  box.axes = {{{{4e-3, 4, 1.0}}, {{4e-3, 4, 1.0}}, {{1e-3, 2, 1.0}, {10e-3, 5, 1.0}, {1e-3, 2, 1.0}}}};
  box.base_region = "steel";
  box.regions = {{.name = "gel", .lower = {-1.0, -1.0, 1e-3}, .upper = {1.0, 1.0, 11e-3}}};
  const Mesh mesh = make_box_hexes(box);
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : mesh.region_names)
    by_region.push_back(from_young_poisson(name == "gel" ? 1e4 : 200e9, 0.0));
  const auto held = [](const Vector&) -> Vector { return Vector::Zero(); };
  const auto moved_by = [](const Vector&, double t) -> Vector { return t * Vector(0.3e-3, 0.0, 1e-3); };
  const FractureModel model =
      elastic_model(by_region, {displacement_on("zmin", held), moved("zmax", {true, true, true}, moved_by)});
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  Sheared result;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step == 0) return;
    result.force = report.reaction[mesh.patch_index("zmin")].x();
    result.moved = report.reaction[mesh.patch_index("zmax")].x();
    for (const std::string& remark : report.remarks) result.remarks += remark;
  });
  return result;
}

TEST(SoftBetweenStiff, IsToldOfWhereItIsOutOfBalance) {
  const Sheared loose = shear(1e-6), tight = shear(1e-12);
  report_row(
      "tolerance",
      {{"1e-6: held", loose.force}, {"moved", loose.moved}, {"1e-12: held", tight.force}, {"moved", tight.moved}});
  EXPECT_NEAR(tight.moved / tight.force, -1.0, 0.01);
  EXPECT_THAT(tight.remarks, testing::Not(testing::HasSubstr("out of balance")));
  EXPECT_GT(std::abs(loose.moved / loose.force + 1.0), 0.5);
  EXPECT_THAT(loose.remarks, testing::HasSubstr("out of balance"));
}

}  // namespace
}  // namespace pfdm::verification::soft_between_stiff
