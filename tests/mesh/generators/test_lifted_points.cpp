// Points next to a surface are moved to where the cells around them are well shaped; others stay.

#include "mesh/generators/lifted_points.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm::this_file {
namespace {

// The unit cube, its twelve triangles joined to an inner point.
TetgenOutput cube_around(const Vector& inner) {
  TetgenOutput mesh;
  for (const double z : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0}) mesh.points.emplace_back(x, y, z);
  mesh.points.push_back(inner);
  for (const auto& [p, q, r, s] :
       {std::array<Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.tetrahedra.push_back({p, r, q, 8});
    mesh.tetrahedra.push_back({p, s, r, 8});
  }
  mesh.region.resize(mesh.tetrahedra.size(), 0);
  return mesh;
}

std::vector<double> volumes(const TetgenOutput& mesh) {
  std::vector<double> result;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const Vector& x = mesh.points[a];
    result.push_back((mesh.points[b] - x).cross(mesh.points[c] - x).dot(mesh.points[d] - x) / 6.0);
  }
  return result;
}

TEST(LiftedPoints, AreMovedWhereCellsAreWellShaped) {
  for (const double lift : {1e-7, 1e-4})
    for (const Vector& from : {Vector(0.0, 0.0, 0.0), Vector(1.0, 0.0, 1.0)}) {
      TetgenOutput mesh = cube_around(from + lift * (Vector(0.5, 0.5, 0.5) - from));
      EXPECT_LT(std::ranges::min(volumes(mesh)), lift);
      settle_lifted_points(8, mesh);
      const std::vector<double> after = volumes(mesh);
      EXPECT_GT(std::ranges::min(after), 0.07);  // 1/12 at the centre
      for (std::size_t p = 0; p < 8; ++p) EXPECT_EQ(mesh.points[p], cube_around(from).points[p]);
    }
}

TEST(LiftedPoints, AreThoseNextToAnotherAlone) {
  const Vector inner(0.1, 0.2, 0.1);
  TetgenOutput mesh = cube_around(inner);
  settle_lifted_points(8, mesh);
  EXPECT_EQ(mesh.points[8], inner);
}

}  // namespace
}  // namespace pfdm::this_file
