#include "mesh/dual.h"
#include "physics/error.h"
#include "postproc/fields/slice.h"
#include "tests/postproc/boxes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::test::this_file {
namespace {

const Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();

// 2 x 3 x 5 m, graded.
Mesh box() { return box_mesh({2.0, 4, 3.0}, {3.0, 6, 0.5}, {5.0, 5, 1.0}); }

// Each hexahedron cut into the six tetrahedra about its diagonal from point 0 to point 6.
Mesh tetrahedra(const Mesh& hexes) {
  CellSoup soup;
  soup.points = hexes.points;
  soup.region_names = {"body"};
  constexpr std::size_t rim[] = {1, 2, 3, 7, 4, 5, 1};
  for (Index cell = 0; cell < hexes.n_cells(); ++cell) {
    const auto p = hexes.points_of_cell(cell);
    for (std::size_t i = 0; i < 6; ++i)
      soup.add_cell(CellShape::tetrahedron, std::vector<Index>{p[0], p[rim[i]], p[rim[i + 1]], p[6]}, 0);
  }
  return assemble_mesh(std::move(soup), {});
}

CellField<double> broken(const Mesh& mesh) { return CellField<double>(mesh.n_cells(), 1.0); }

TEST(DamagedArea, of_a_broken_box_is_its_section) {
  for (const Mesh& mesh : {box(), tetrahedra(box()), barycentric_dual(tetrahedra(box()))}) {
    const Vector inside(0.777, 1.234, 2.345);
    EXPECT_NEAR(damaged_area(mesh, broken(mesh), inside, x), 15.0, 1e-12);
    EXPECT_NEAR(damaged_area(mesh, broken(mesh), inside, y), 10.0, 1e-12);
    EXPECT_NEAR(damaged_area(mesh, broken(mesh), inside, -3.0 * z), 6.0, 1e-12);
    EXPECT_NEAR(damaged_area(mesh, broken(mesh), Vector(1, 1.5, 2.5), Vector(3, 2, 0)), 5.0 * std::sqrt(13.0), 1e-12);
  }
}

TEST(DamagedArea, of_a_hexagonal_section) {
  const Mesh cube = cube_mesh(1.0, 3);
  for (const Mesh& mesh : {cube, tetrahedra(cube), barycentric_dual(tetrahedra(cube))})
    EXPECT_NEAR(damaged_area(mesh, broken(mesh), Vector(0.5, 0.5, 0.5), Vector(1, 1, 1)), 0.75 * std::sqrt(3.0), 1e-12);
}

TEST(DamagedArea, counts_planes_along_faces_once) {
  for (const Mesh& mesh : {box(), tetrahedra(box()), barycentric_dual(tetrahedra(box()))})
    for (const double height : {0.0, 2.0, 3.0, 5.0})
      for (const double sign : {-1.0, 1.0})
        EXPECT_NEAR(damaged_area(mesh, broken(mesh), Vector(0, 0, height), sign * z), 6.0, 1e-12) << height;
}

// The corner of a cube is one region, whose surface is not plane in the dual's faces.
TEST(DamagedArea, of_a_region_is_that_of_the_dual) {
  Mesh mesh = tetrahedra(box());
  mesh.region_names = {"rest", "corner"};
  for (Index c = 0; c < mesh.n_cells(); ++c) mesh.region[c] = mesh.cell_centre[c].sum() < 4.0 ? 1 : 0;
  const Mesh dual = barycentric_dual(mesh);
  const auto in_corner = [](const Mesh& of) {
    CellField<double> damage(of.n_cells());
    for (Index c = 0; c < of.n_cells(); ++c) damage[c] = of.region[c];
    return damage;
  };
  for (const Vector& normal : {x, z, Vector(1, 2, 3)}) {
    const Vector point(0.31, 0.57, 0.83);
    const double area = damaged_area(mesh, in_corner(mesh), point, normal);
    EXPECT_GT(area, 1.0);
    EXPECT_NEAR(damaged_area(dual, in_corner(dual), point, normal), area, 1e-12);
  }
}

TEST(DamagedArea, shares_a_face_between_a_broken_and_a_sound_cell) {
  const Mesh mesh = box_mesh({2.0, 2, 1.0}, {1.0, 1, 1.0}, {1.0, 1, 1.0});
  CellField<double> damage(2);
  damage[0] = 1.0;
  EXPECT_NEAR(damaged_area(mesh, damage, Vector(1, 0, 0), x), 0.5, 1e-14);
}

TEST(DamagedArea, counts_only_cells_beyond_the_threshold) {
  const Mesh mesh = box();
  CellField<double> damage(mesh.n_cells());
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) damage[cell] = mesh.cell_centre[cell].z() < 3.0 ? 0.6 : 0.5;
  EXPECT_NEAR(damaged_area(mesh, damage, Vector(0.7, 0, 0), x), 9.0, 1e-12);
  EXPECT_NEAR(damaged_area(mesh, damage, Vector(0.7, 0, 0), x, 0.4), 15.0, 1e-12);
  EXPECT_EQ(damaged_area(mesh, damage, Vector(0.7, 0, 0), x, 0.6), 0.0);
}

TEST(DamagedArea, is_zero_outside_the_body) {
  const Mesh mesh = box();
  EXPECT_EQ(damaged_area(mesh, broken(mesh), Vector(-0.1, 0, 0), x), 0.0);
  EXPECT_EQ(damaged_area(mesh, broken(mesh), Vector(2.1, 0, 0), x), 0.0);
}

TEST(DamagedArea, does_not_depend_on_the_size_of_the_body) {
  const Mesh mesh = box_mesh({2e-5, 4, 1.0}, {3e-5, 3, 1.0}, {5e-5, 5, 1.0});
  EXPECT_NEAR(damaged_area(mesh, broken(mesh), Vector(1.1e-5, 0, 0), x), 15e-10, 1e-22);
  EXPECT_NEAR(damaged_area(mesh, broken(mesh), Vector(1e-5, 0, 0), x), 15e-10, 1e-22);
}

TEST(DamagedArea, refuses_a_plane_without_direction) {
  const Mesh mesh = box();
  EXPECT_THROW(damaged_area(mesh, broken(mesh), Vector::Zero(), Vector::Zero()), InputError);
}

}  // namespace
}  // namespace pfdm::test::this_file
