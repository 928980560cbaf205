// Spheres, boxes and the checks that surfaces pass before TetGen gets them.

#include <cmath>
#include <numbers>

#include "mesh/surfaces/box_surface.h"
#include "mesh/surfaces/surface_checks.h"
#include "mesh/surfaces/triangle_surface.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

double enclosed_volume(const TriangleSurface& surface) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](Index i) { return surface.points[i]; };
    six_volumes += at(a).dot(at(b).cross(at(c)));
  }
  return six_volumes / 6.0;
}

TEST(TriangleSurface, OfTooManyTrianglesIsRefused) {
  EXPECT_THROW(unit_icosphere(1000000), InputError);
  EXPECT_THROW(unit_icosphere(icosphere_subdivision(1e-9, 1.0)), InputError);
}

TEST(Icosphere, HasItsCountsAndIsClosed) {
  for (const Index n : {1, 2, 5, 8}) {
    const TriangleSurface sphere = unit_icosphere(n);
    EXPECT_EQ(sphere.triangles.size(), static_cast<std::size_t>(20 * n * n));
    EXPECT_EQ(sphere.points.size(), static_cast<std::size_t>(10 * n * n + 2));
    for (const Vector& x : sphere.points) EXPECT_NEAR(x.norm(), 1.0, 1e-15);
    EXPECT_NO_THROW(check_surfaces({{"the sphere", sphere}}));
  }
}

TEST(Icosphere, VolumeConvergesQuadratically) {
  const double exact = 4.0 / 3.0 * std::numbers::pi;
  const double coarse = exact - enclosed_volume(unit_icosphere(8));
  const double fine = exact - enclosed_volume(unit_icosphere(16));
  EXPECT_NEAR(coarse / fine, 4.0, 0.05);
}

TEST(Icosphere, SizeAndSubdivisionAreInverse) {
  for (const Index n : {1, 3, 13, 24}) EXPECT_EQ(icosphere_subdivision(icosphere_size(n, 0.3), 0.3), n);
  EXPECT_EQ(icosphere_subdivision(100.0, 1.0), 1);
  // 20 n^2 equilateral triangles of that side have the sphere's area.
  const double side = icosphere_size(5, 2.0);
  EXPECT_NEAR(500.0 * std::sqrt(3.0) / 4.0 * side * side, 16.0 * std::numbers::pi, 1e-10);
}

TEST(BoxSurface, IsClosedOnUnequalSides) {
  const Vector lower(-1, 0, 2);
  const Vector upper(1, 5, 3);
  const BoxNodes nodes = uniform_box_nodes(lower, upper, 0.4);
  EXPECT_EQ(nodes[0].size(), 6U);
  EXPECT_EQ(nodes[1].size(), 14U);
  const TriangleSurface box = box_surface(nodes);
  EXPECT_NO_THROW(check_surfaces({{"the box", box}}));
  EXPECT_NEAR(enclosed_volume(box), 10.0, 1e-12);
}

TEST(BoxSurface, FollowsTheSizeFieldWithinItsStretch) {
  const SizeField size({{Vector(0, 0, 0.9), 0.05, 0.01, 0.05, 0.01, 1.0}}, 0.3, 1.0);
  const BoxNodes nodes = graded_box_nodes(Vector::Constant(-1), Vector::Constant(1), size);
  const double wanted = 0.01 + 0.3 * 0.05;  // at the top, beside the ball
  const auto width_at = [](const std::vector<double>& x, double at) {
    const auto above = std::upper_bound(x.begin(), x.end() - 1, at);
    return *above - *(above - 1);
  };
  EXPECT_NEAR(width_at(nodes[0], 0.001), wanted, 0.15 * wanted);
  EXPECT_NEAR(width_at(nodes[0], -0.99), 2.0 * wanted, 0.15 * wanted);
}

TEST(SizeField, GrowsOnBothSidesOfTheShellUpToItsCaps) {
  const SizeField size({{Vector::Zero(), 1.4, 0.14, 1.0, 0.1, 0.2}}, 0.5, 0.6);
  EXPECT_NEAR(size(Vector(1.6, 0, 0)), 0.24, 1e-14);
  EXPECT_NEAR(size(Vector(1.2, 0, 0)), 0.14, 1e-14);
  EXPECT_NEAR(size(Vector(0, 9, 0)), 0.6, 1e-14);
  EXPECT_NEAR(size(Vector(0, 0, 0.9)), 0.15, 1e-14);
  EXPECT_NEAR(size(Vector(0, 0, 0.1)), 0.2, 1e-14);
}

TEST(SurfaceChecks, NameWhatIsWrong) {
  const TriangleSurface sphere = unit_icosphere(3);
  TriangleSurface open = sphere;
  open.triangles.pop_back();
  EXPECT_THAT(message_of<InputError>([&] { check_surfaces({{"bead 7", open}}); }), HasSubstr("bead 7 is not closed"));

  TriangleSurface inside_out = sphere;
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(message_of<InputError>([&] { check_surfaces({{"bead 7", inside_out}}); }), HasSubstr("inside out"));

  TriangleSurface twisted = sphere;
  std::swap(twisted.triangles[4][0], twisted.triangles[4][1]);
  EXPECT_THAT(message_of<InputError>([&] {
                check_surfaces({{"bead 7", twisted}});
              }),
              HasSubstr("not an orientable manifold"));

  TriangleSurface shifted = sphere;
  for (Vector& x : shifted.points) x[0] += 1.5;
  EXPECT_THAT(message_of<InputError>([&] {
                check_surfaces({{"bead 7", sphere}, {"bead 8", shifted}});
              }),
              ::testing::AllOf(HasSubstr("bead 7"), HasSubstr("bead 8"), HasSubstr("intersect")));

  TriangleSurface dented = sphere;
  dented.points[0] *= -1.5;
  EXPECT_THAT(message_of<InputError>([&] { check_surfaces({{"bead 7", dented}}); }), HasSubstr("intersect"));
}

}  // namespace
}  // namespace pfdm::this_file
