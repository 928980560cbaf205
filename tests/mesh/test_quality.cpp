#include <cmath>

#include "mesh/generators/box_hexes.h"
#include "mesh/quality.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

Mesh single(CellShape shape, std::vector<Vector> points) {
  CellSoup soup;
  soup.points = std::move(points);
  soup.region_names = {"body"};
  std::vector<Index> ids(soup.points.size());
  std::iota(ids.begin(), ids.end(), 0);
  soup.add_cell(shape, ids, 0);
  return assemble_mesh(std::move(soup), {});
}

TEST(Quality, UnitCubes) {
  BoxHexesSettings settings;
  settings.axes = {{{{2.0, 2, 1.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  const CellQuality cells = cell_quality(mesh);
  for (Index c = 0; c < 2; ++c) {
    EXPECT_NEAR(cells.non_orthogonality[c], 0.0, 1e-12);
    EXPECT_NEAR(cells.skewness[c], 0.0, 1e-14);
    EXPECT_NEAR(cells.volume_ratio[c], 1.0, 1e-14);
    EXPECT_NEAR(cells.aspect_ratio[c], 1.0, 1e-14);
    EXPECT_NEAR(cells.min_dihedral_angle[c], 90.0, 1e-12);
  }
}

TEST(Quality, StretchedBoxes) {
  BoxHexesSettings settings;
  settings.axes = {{{{4.0, 2, 3.0}}, {{0.5, 1, 1.0}}, {{1.0, 1, 1.0}}}};
  const CellQuality cells = cell_quality(make_box_hexes(settings));
  EXPECT_NEAR(cells.volume_ratio[0], 3.0, 1e-13);
  const auto [low, high] = std::ranges::minmax(cells.aspect_ratio.values());
  EXPECT_NEAR(low, 2.0, 1e-13);
  EXPECT_NEAR(high, 6.0, 1e-13);
}

TEST(Quality, RegularTetrahedron) {
  const Mesh mesh = single(CellShape::tetrahedron, {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}});
  const CellQuality cells = cell_quality(mesh);
  EXPECT_NEAR(cells.min_dihedral_angle[0], 70.528779365509, 1e-10);
  EXPECT_NEAR(cells.aspect_ratio[0], 1.0, 1e-14);
}

TEST(Quality, FlatWedgeHasItsSharpAngle) {
  const double height = std::tan(20.0 * M_PI / 180.0);
  const Mesh mesh =
      single(CellShape::wedge, {{0, 0, 0}, {1, height, 0}, {1, 0, 0}, {0, 0, 1}, {1, height, 1}, {1, 0, 1}});
  EXPECT_NEAR(cell_quality(mesh).min_dihedral_angle[0], 20.0, 1e-10);
}

TEST(Quality, ShearedCellsAreNotOrthogonalAndSkew) {
  // Two unit cubes, all sheared by 45 degrees in x against z: the face between them (normal x) stays, the centre line
  // keeps along x, so that pair is orthogonal; a pair on top of each other is 45 degrees off.
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}, {{2.0, 2, 1.0}}}};
  const Mesh straight = make_box_hexes(settings);
  CellSoup soup;
  soup.points = straight.points;
  for (Vector& x : soup.points) x[0] += x[2];
  soup.region_names = {"body"};
  for (Index c = 0; c < 2; ++c) soup.add_cell(CellShape::hexahedron, straight.points_of_cell(c), 0);
  const CellQuality cells = cell_quality(assemble_mesh(soup, {}));
  EXPECT_NEAR(cells.non_orthogonality[0], 45.0, 1e-10);
  EXPECT_NEAR(cells.skewness[0], 0.0, 1e-13);
  EXPECT_NEAR(cells.min_dihedral_angle[0], 45.0, 1e-10);
}

TEST(Quality, SkewnessIsTheDistanceFromTheFacesCentre) {
  // A unit cube beside one of double height: the centre line from z = 1/2 to z = 1 pierces their plane x = 1 ... but
  // only conforming faces count, so the second is a prism over the same face, leaning: its far side is one up.
  CellSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {2, 0, 1}, {2, 1, 1}, {2, 1, 2}, {2, 0, 2}};
  soup.region_names = {"body"};
  soup.add_cell(CellShape::hexahedron, std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7}, 0);
  soup.add_cell(CellShape::hexahedron, std::vector<Index>{1, 8, 9, 2, 5, 11, 10, 6}, 0);
  const CellQuality cells = cell_quality(assemble_mesh(soup, {}));
  // Centres (0.5, 0.5, 0.5) and (1.5, 0.5, 1): the line crosses x = 1 at z = 0.75, the face's centre is at 0.5.
  EXPECT_NEAR(cells.skewness[0], 0.25 / std::sqrt(1.25), 1e-13);
  EXPECT_NEAR(cells.non_orthogonality[0], std::atan(0.5) * 180.0 / M_PI, 1e-10);
}

TEST(Quality, SummaryCountsAndDescribes) {
  BoxHexesSettings settings;
  settings.axes = {{{{4.0, 4, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 1, 1.0}}}};
  settings.regions = {{"end", {3.0, 0, 0}, {4.0, 1, 1}}};
  const MeshQuality quality = mesh_quality(make_box_hexes(settings));
  EXPECT_EQ(quality.n_cells, 8);
  EXPECT_EQ(quality.shapes, (std::vector<NamedCount>{{"hexahedra", 8}}));
  EXPECT_EQ(quality.regions, (std::vector<NamedCount>{{"body", 6}, {"end", 2}}));
  EXPECT_EQ(quality.patches.size(), 6U);
  EXPECT_NEAR(quality.volume, 4.0, 1e-13);
  EXPECT_NEAR(quality.min_dihedral_angle.mean, 90.0, 1e-10);
  const std::string text = describe(quality);
  EXPECT_THAT(text, HasSubstr("8 cells: 8 hexahedra"));
  EXPECT_THAT(text, HasSubstr("6 body, 2 end"));
  EXPECT_THAT(text, HasSubstr("non-orthogonality"));
  EXPECT_LE(std::ranges::count(text, '\n'), 12);
}

}  // namespace
}  // namespace pfdm::this_file
