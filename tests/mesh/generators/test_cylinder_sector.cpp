#include <cmath>
#include <numbers>

#include "mesh/generators/cylinder_sector.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;
constexpr double azimuth = pi / 36.0;

CylinderSectorSettings cylinder(double inner_radius = 0.0) {
  return {.azimuth = azimuth,
          .inner_radius = inner_radius,
          .bottom = -1.0,
          .radius = {{1.0, 5, 0.5}, {1.0, 4, 1.0}},
          .height = {{2.0, 6, 1.0}, {1.0, 4, 0.5}}};
}

// Area of the plane sector between two radii, and that which its chord leaves out.
double sector_area(double inner, double outer) { return 0.5 * std::sin(azimuth) * (outer * outer - inner * inner); }

Vector centre_of(const Mesh& mesh, const std::string& patch) {
  const Patch& faces = mesh.patch(patch);
  Vector moment = Vector::Zero();
  double area = 0.0;
  for (Index f = faces.first_face; f < faces.first_face + faces.n_faces; ++f) {
    moment += mesh.face_area[f].norm() * mesh.face_centre[f];
    area += mesh.face_area[f].norm();
  }
  return moment / area;
}

TEST(CylinderSector, FullOneHasWedgesOnItsAxis) {
  const Mesh mesh = make_cylinder_sector(cylinder());
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_cells(), 9 * 10);
  EXPECT_EQ(count_cells(mesh, CellShape::wedge), 10);
  EXPECT_EQ(mesh.points.size(), 11U * (1 + 2 * 9));
  EXPECT_NEAR(total_volume(mesh), 3.0 * sector_area(0.0, 2.0), 1e-12);
  EXPECT_EQ(mesh.patches.size(), 5U);
  EXPECT_NEAR(patch_area(mesh, "top").z(), sector_area(0.0, 2.0), 1e-12);
  EXPECT_NEAR(patch_area(mesh, "bottom").z(), -sector_area(0.0, 2.0), 1e-12);
  EXPECT_NEAR(patch_area(mesh, "outer").x(), 3.0 * 4.0 * std::sin(0.5 * azimuth), 1e-12);
  EXPECT_NEAR(patch_area(mesh, "front").y(), -6.0 * std::cos(0.5 * azimuth), 1e-12);
  EXPECT_NEAR(patch_area(mesh, "back").y(), 6.0 * std::cos(0.5 * azimuth), 1e-12);
}

TEST(CylinderSector, UpperEndIsPartOfASphere) {
  CylinderSectorSettings settings = cylinder();
  settings.upper_sphere = 5.0;
  settings.radius = {{2.0, 80, 1.0}};
  const Mesh mesh = make_cylinder_sector(settings);
  expect_sound(mesh);
  const double sag = 5.0 - std::sqrt(5.0 * 5.0 - 2.0 * 2.0);
  double farthest = 0.0;
  const Patch& top = mesh.patch("top");
  for (Index f = top.first_face; f < top.first_face + top.n_faces; ++f)
    for (const Index p : mesh.points_of_face(f))
      farthest = std::max(farthest, std::abs((mesh.points[p] - Vector(0, 0, 2.0 + 5.0)).norm() - 5.0));
  EXPECT_LT(farthest, 1e-12);
  const double cap = pi * sag * sag * (5.0 - sag / 3.0);  // volume of the spherical cap
  EXPECT_NEAR(total_volume(mesh) / ((pi * 4.0 * (3.0 + sag) - cap) / 72.0), 1.0, 0.002);
}

TEST(CylinderSector, HasRegionsHolesSlitsAndPatches) {
  CylinderSectorSettings settings = cylinder();
  settings.regions = {{"core", 0.0, 1.0, -1.0, 1.0}};
  settings.slits = {{"penny", 0.0, 1.0, 1.0, 1.0}};
  settings.holes = {{"groove", 1.5, 2.0, 1.0, 2.0}};
  settings.patches = {{"ring", 1.0, 1.5, 2.0, 2.0}};
  const Mesh mesh = make_cylinder_sector(settings);
  expect_sound(mesh);
  EXPECT_NEAR(region_volume(mesh, "core"), 2.0 * sector_area(0.0, 1.0), 1e-12);
  EXPECT_NEAR(region_volume(mesh, "body"),
              3.0 * sector_area(0.0, 2.0) - 2.0 * sector_area(0.0, 1.0) - sector_area(1.5, 2.0), 1e-12);
  EXPECT_EQ(mesh.patch("penny").n_faces, 2 * 5);
  EXPECT_NEAR(patch_area(mesh, "penny").norm(), 0.0, 1e-15);
  EXPECT_NEAR(centre_of(mesh, "penny").z(), 1.0, 1e-12);
  EXPECT_EQ(mesh.patch("groove").n_faces, 2 + 4);
  EXPECT_NEAR(patch_area(mesh, "ring").z(), sector_area(1.0, 1.5), 1e-12);
  EXPECT_NEAR(patch_area(mesh, "top").z(), sector_area(0.0, 1.0), 1e-12);
}

TEST(CylinderSector, HollowOneHasAnInside) {
  const Mesh mesh = make_cylinder_sector(cylinder(0.5));
  expect_sound(mesh);
  EXPECT_EQ(count_cells(mesh, CellShape::hexahedron), 9 * 10);
  EXPECT_NEAR(total_volume(mesh), 3.0 * sector_area(0.5, 2.5), 1e-12);
  EXPECT_NEAR(patch_area(mesh, "inner").x(), -3.0 * 2.0 * 0.5 * std::sin(0.5 * azimuth), 1e-12);
}

TEST(CylinderSector, RefusesWhatIsOutOfRange) {
  const auto refusal = [](const CylinderSectorSettings& settings) {
    return message_of<InputError>([&] { make_cylinder_sector(settings); });
  };
  CylinderSectorSettings settings = cylinder();
  settings.azimuth = 2.0;
  EXPECT_THAT(refusal(settings), HasSubstr("at most 45"));
  EXPECT_THAT(refusal(cylinder(-0.1)), HasSubstr("inner radius is -100 mm"));
  settings = cylinder();
  settings.upper_sphere = 1.5;
  EXPECT_THAT(refusal(settings), HasSubstr("larger than that of the sector, 2 m"));
  settings = cylinder();
  settings.height.clear();
  EXPECT_THAT(refusal(settings), HasSubstr("along its height has no cells"));
  settings = cylinder();
  settings.slits = {{"cone", 0.0, 1.0, 0.0, 1.0}};
  EXPECT_THAT(refusal(settings), HasSubstr("slit \"cone\""));
}

}  // namespace
}  // namespace pfdm::this_file
