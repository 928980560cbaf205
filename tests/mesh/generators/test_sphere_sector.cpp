#include <cmath>
#include <numbers>

#include "mesh/generators/sphere_sector.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;

SphereSectorSettings ball(double polar, double inner_radius = 0.0) {
  return {.azimuth = pi / 36.0,
          .inner_radius = inner_radius,
          .shells = {{{1.0, 6, 0.5}, "core"}, {{0.5, 2, 1.0}, "skin"}, {{1.0, 3, 2.0}, "core"}},
          .polar = {{0.25 * polar, 12, 0.5}, {0.75 * polar, 36, 1.0}}};
}

// Of a sector with plane faces: chords in azimuth and polar angle make it smaller than the ball's share.
double sector_volume(double radius) { return 4.0 / 3.0 * pi * std::pow(radius, 3) / 72.0; }

TEST(SphereSector, FillsItsShareOfTheBall) {
  const Mesh mesh = make_sphere_sector(ball(pi));
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_cells(), 11 * 48);
  EXPECT_NEAR(total_volume(mesh) / sector_volume(2.5), 1.0, 0.004);
  EXPECT_NEAR(region_volume(mesh, "skin") / (sector_volume(1.5) - sector_volume(1.0)), 1.0, 0.004);
  EXPECT_EQ(count_cells(mesh, CellShape::tetrahedron), 2);
  EXPECT_EQ(count_cells(mesh, CellShape::pyramid), 46);
  EXPECT_EQ(count_cells(mesh, CellShape::wedge), 20);
  EXPECT_EQ(mesh.patches.size(), 3U);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"core", "skin"}));
}

TEST(SphereSector, HalfAHollowOneHasAnEquatorAndAnInside) {
  const Mesh mesh = make_sphere_sector(ball(0.5 * pi, 0.5));
  expect_sound(mesh);
  EXPECT_EQ(count_cells(mesh, CellShape::hexahedron), 11 * 47);
  EXPECT_EQ(mesh.patches.size(), 5U);
  const double share = pi * (3.0 * 3.0 - 0.5 * 0.5) / 72.0;
  EXPECT_NEAR(-patch_area(mesh, "equator").z() / share, 1.0, 0.002);
  EXPECT_LT(patch_area(mesh, "inner").x(), 0.0);
  EXPECT_GT(patch_area(mesh, "outer").z(), 0.0);
  EXPECT_NEAR(patch_area(mesh, "front").x(), patch_area(mesh, "back").x(), 1e-12);
}

TEST(SphereSector, RefusesWhatIsOutOfRange) {
  const auto refusal = [](const SphereSectorSettings& settings) -> std::string {
    try {
      make_sphere_sector(settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refusal(ball(0.7 * pi)), HasSubstr("126 degrees"));
  SphereSectorSettings settings = ball(pi);
  settings.azimuth = 2.0;
  EXPECT_THAT(refusal(settings), HasSubstr("at most 45"));
  settings = ball(pi);
  settings.shells.clear();
  EXPECT_THAT(refusal(settings), HasSubstr("along its radius has no cells"));
  settings = ball(pi, -1.0);
  EXPECT_THAT(refusal(settings), HasSubstr("inner radius"));
}

}  // namespace
}  // namespace pfdm::this_file
