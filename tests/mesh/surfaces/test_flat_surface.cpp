// Which cells a plane surface goes through.

#include "mesh/search/flat_surface.h"

#include "mesh/dual.h"
#include "mesh/generators/box_hexes.h"
#include "mesh/generators/particles_in_box.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

#include <numbers>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

// Cells of a tenth in the unit cube.
Mesh cube() {
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, 10, 1.0}}, {{1.0, 10, 1.0}}, {{1.0, 10, 1.0}}}};
  return make_box_hexes(settings);
}

std::pair<double, double> range_of_z(const Mesh& mesh, const std::vector<Index>& cells) {
  double least = 1e300, most = -1e300;
  for (const Index c : cells) {
    least = std::min(least, mesh.cell_centre[c][2]);
    most = std::max(most, mesh.cell_centre[c][2]);
  }
  return {least, most};
}

std::vector<Index> below(const Mesh& mesh, double z, const Vector& normal) {
  return cells_on(mesh, disc({0.5, 0.5, z}, normal, 10.0));
}

TEST(FlatSurface, GoesThroughOneLayerOfCells) {
  const Mesh mesh = cube();
  const Vector up = Vector::UnitZ();
  for (const auto& [z, normal, layer] : {std::tuple{0.33, up, 0.35},
                                         {0.4, up, 0.45},
                                         {0.4, Vector(-up), 0.35},
                                         {0.0, up, 0.05},
                                         {0.0, Vector(-up), 0.05},
                                         {1.0, up, 0.95},
                                         {1.0, Vector(-up), 0.95}}) {
    const std::vector<Index> cells = below(mesh, z, normal);
    EXPECT_EQ(cells.size(), 100U) << z;
    const auto [least, most] = range_of_z(mesh, cells);
    EXPECT_NEAR(least, layer, 1e-12) << z;
    EXPECT_NEAR(most, layer, 1e-12) << z;
  }
  EXPECT_TRUE(below(mesh, 1.001, up).empty());
}

TEST(FlatSurface, EndsAtItsOutline) {
  const Mesh mesh = cube();
  const std::vector<Vector> rectangle{{0.0, 0.0, 0.5}, {0.3, 0.0, 0.5}, {0.3, 0.5, 0.5}, {0.0, 0.5, 0.5}};
  EXPECT_EQ(cells_on(mesh, polygon(rectangle)).size(), 15U);
  const std::vector<Vector> corner{{0.0, 0.0, 0.5}, {1.0, 0.0, 0.5}, {1.0, 0.3, 0.5},
                                   {0.3, 0.3, 0.5}, {0.3, 1.0, 0.5}, {0.0, 1.0, 0.5}};
  EXPECT_EQ(cells_on(mesh, polygon(corner)).size(), 30U + 21U);
  EXPECT_EQ(cells_on(mesh, strip({0.0, 0.0, 0.55}, {0.3, 7.0, 0.55}, Vector::UnitY())).size(), 30U);
  EXPECT_EQ(cells_on(mesh, strip({0.0, 0.55, 0.0}, {0.3, 0.55, 0.0}, Vector::UnitZ())).size(), 30U);
  EXPECT_NEAR(double(cells_on(mesh, disc({0.5, 0.5, 0.55}, Vector::UnitZ(), 0.4)).size()),
              100.0 * std::numbers::pi * 0.16, 4.0);
}

// A staircase of cells that meet at faces would take 19 a layer.
TEST(FlatSurface, TakesCellsThatMeetAtEdgesWhereItIsOblique) {
  const Mesh mesh = cube();
  for (const double offset : {0.0, 0.03, -0.02})
    EXPECT_EQ(cells_on(mesh, disc({0.5 + offset, 0.5, 0.5}, Vector(1.0, -1.0, 0.0), 10.0)).size(), 100U) << offset;
}

// No two cells that share a face are on two sides of it.
void expect_cut(const Mesh& mesh, const Vector& point, const Vector& normal) {
  CellField<char> on(mesh.n_cells(), 0);
  for (const Index c : cells_on(mesh, disc(point, normal, 1e3))) on[c] = 1;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (on[P] == 0 && on[N] == 0) {
      EXPECT_GT(normal.dot(mesh.cell_centre[P] - point) * normal.dot(mesh.cell_centre[N] - point), 0.0);
    }
  }
}

TEST(FlatSurface, LeavesNoWayAround) {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-3.0);
  settings.upper = Vector::Constant(3.0);
  Particle sphere;
  sphere.radius = 1.0;
  sphere.subdivision = 3;
  sphere.n_layers = 4;
  sphere.layer_thickness = 0.4;
  settings.particles = {sphere};
  const Mesh mesh = make_particles_in_box(settings);
  const Vector oblique = Vector(1.0, -2.0, 3.0).normalized();
  for (const Mesh& cells : {mesh, barycentric_dual(mesh)}) {
    expect_cut(cells, Vector::Zero(), Vector::UnitZ());
    expect_cut(cells, {0.1, 0.2, 0.7}, oblique);
  }
  expect_cut(cube(), {0.5, 0.5, 0.5}, oblique);
  expect_cut(cube(), {0.5, 0.5, 0.5}, Vector::UnitX());
}

TEST(FlatSurface, ThatIsNoneIsRefused) {
  EXPECT_THAT(message_of<InputError>([] {
                polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}});
              }),
              HasSubstr("off the plane"));
  EXPECT_THAT(message_of<InputError>([] { polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}); }), HasSubstr("collinear"));
  EXPECT_THAT(message_of<InputError>([] { strip({0, 0, 0}, {0, 0, 1}, Vector::UnitZ()); }), HasSubstr("no surface"));
}

}  // namespace
}  // namespace pfdm::this_file
