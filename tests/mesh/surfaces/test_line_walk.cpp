#include "mesh/generators/box_hexes.h"
#include "mesh/generators/particles_in_box.h"
#include "mesh/search/line_walk.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

// The segments follow one another without gaps, through faces that their cells share.
void expect_connected(const Mesh& mesh, const std::vector<LineSegment>& line, double length) {
  double at = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_NEAR(line[i].begin, at, 1e-8 * length);
    at = line[i].begin + line[i].length;
    if (i > 0 && line[i].entry == line[i - 1].exit) {
      EXPECT_EQ(mesh.across(line[i].entry, line[i - 1].cell), line[i].cell);
    }
  }
  EXPECT_NEAR(at, length, 1e-8 * length);
}

TEST(LineWalk, CrossesARowOfHexahedra) {
  BoxHexesSettings box;
  box.axes = {{{{10.0, 10, 3.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(box);
  Index first = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c][0] < mesh.cell_centre[first][0]) first = c;
  const std::vector<LineSegment> line = walk_line(mesh, first, Vector(0.0, 0.5, 0.5), Vector::UnitX(), 100.0);
  ASSERT_EQ(line.size(), 10u);
  expect_connected(mesh, line, 10.0);  // the boundary ends it
  for (const LineSegment& s : line) EXPECT_NEAR(s.length, mesh.cell_volume[s.cell], 1e-12);
  EXPECT_EQ(walk_line(mesh, first, Vector(0.0, 0.5, 0.5), -Vector::UnitX(), 1.0).size(), 0u);
  const std::vector<LineSegment> part =
      walk_line(mesh, line[3].cell, mesh.cell_centre[line[3].cell], Vector::UnitX(), 0.25 * line[3].length);
  ASSERT_EQ(part.size(), 1u);
  EXPECT_EQ(part[0].entry, -1);
  EXPECT_EQ(part[0].exit, -1);
}

TEST(LineWalk, CrossesTetrahedraAndPrisms) {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-2.0);
  settings.upper = Vector::Constant(2.0);
  settings.particles = {{.radius = 1.0, .subdivision = 3, .n_layers = 3, .layer_thickness = 0.3}};
  settings.size_far = 0.8;
  const Mesh mesh = make_particles_in_box(settings);
  int n_lines = 0;
  for (Index c = 0; c < mesh.n_cells(); c += 37, ++n_lines) {
    const Vector direction = Vector(1.0, 0.3 + 0.01 * n_lines, -0.7).normalized();
    const Vector start = mesh.cell_centre[c];
    double to_boundary = 1e9;
    for (Index k = 0; k < 3; ++k)
      to_boundary = std::min(to_boundary, ((direction[k] > 0.0 ? 2.0 : -2.0) - start[k]) / direction[k]);
    expect_connected(mesh, walk_line(mesh, c, start, direction, 100.0), to_boundary);
    expect_connected(mesh, walk_line(mesh, c, start, direction, 0.5 * to_boundary), 0.5 * to_boundary);
  }
  EXPECT_GT(n_lines, 20);
}

}  // namespace
}  // namespace pfdm::this_file
