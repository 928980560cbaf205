// Faces, neighbours, order and geometry of hand-made cells.

#include <array>

#include "mesh/cell_ordering.h"
#include "mesh/patch_rules.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

CellSoup unit_cube_points() {
  CellSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  soup.region_names = {"body"};
  return soup;
}

void add(CellSoup& soup, CellShape shape, std::vector<Index> points) { soup.add_cell(shape, points, 0); }

CellSoup unit_cube() {
  CellSoup soup = unit_cube_points();
  add(soup, CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  return soup;
}

// A pyramid on the cube's bottom, and its four walls and top by further pyramids about the middle.
CellSoup six_pyramids() {
  CellSoup soup = unit_cube_points();
  soup.points.emplace_back(0.5, 0.5, 0.5);
  const std::array<std::array<Index, 4>, 6> bases{
      {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 5, 6, 2}}};
  for (const auto& b : bases) add(soup, CellShape::pyramid, {b[0], b[1], b[2], b[3], 8});
  return soup;
}

TEST(Assembly, UnitCubeHasItsVolumeCentreAndSides) {
  const Mesh mesh = assemble_mesh(unit_cube(), box_patches(Vector::Zero(), Vector::Ones()));
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_faces(), 6);
  EXPECT_EQ(mesh.n_interior_faces(), 0);
  EXPECT_NEAR(mesh.cell_volume[0], 1.0, 1e-15);
  EXPECT_NEAR((mesh.cell_centre[0] - Vector::Constant(0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((patch_area(mesh, "xmin") - Vector(-1, 0, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((patch_area(mesh, "zmax") - Vector(0, 0, 1)).norm(), 0.0, 1e-15);
}

TEST(Assembly, TetrahedronVolumeAndCentroidAreExact) {
  CellSoup soup;
  soup.points = {{1, 2, 3}, {4, 2, 3}, {1, 6, 3}, {1, 2, 8}};
  soup.region_names = {"body"};
  add(soup, CellShape::tetrahedron, {0, 1, 2, 3});
  const Mesh mesh = assemble_mesh(soup, {});
  expect_sound(mesh);
  EXPECT_NEAR(mesh.cell_volume[0], 10.0, 1e-13);
  EXPECT_NEAR((mesh.cell_centre[0] - Vector(1.75, 3.0, 4.25)).norm(), 0.0, 1e-14);
  EXPECT_EQ(mesh.patches.at(0).name, "walls");
}

TEST(Assembly, WedgeWithBaseLookingOutwards) {
  CellSoup soup = unit_cube_points();
  add(soup, CellShape::wedge, {0, 3, 1, 4, 7, 5});
  add(soup, CellShape::wedge, {1, 3, 2, 5, 7, 6});
  const Mesh mesh = assemble_mesh(soup, {});
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_interior_faces(), 1);
  EXPECT_NEAR(mesh.cell_volume[0], 0.5, 1e-15);
  // Its first triangle must have its normal out of the wedge.
  const auto p = mesh.points_of_cell(0);
  const Vector normal = (mesh.points[p[1]] - mesh.points[p[0]]).cross(mesh.points[p[2]] - mesh.points[p[0]]);
  EXPECT_LT(normal.dot(mesh.cell_centre[0] - mesh.points[p[0]]), 0.0);
}

TEST(Assembly, PyramidsFillTheCube) {
  const Mesh mesh = assemble_mesh(six_pyramids(), box_patches(Vector::Zero(), Vector::Ones()));
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_interior_faces(), 12);
  for (const double volume : mesh.cell_volume) EXPECT_NEAR(volume, 1.0 / 6.0, 1e-15);
}

TEST(Assembly, PolyhedronFacesAreTurnedOutwards) {
  CellSoup soup = unit_cube_points();
  add(soup, CellShape::polyhedron, {0, 1, 2, 3, 4, 5, 6, 7});
  // Three of the six run the wrong way round.
  soup.polyhedron_faces = {
      {6, 4, 0, 1, 2, 3, 4, 4, 5, 6, 7, 4, 0, 4, 5, 1, 4, 3, 2, 6, 7, 4, 0, 4, 7, 3, 4, 1, 2, 6, 5}};
  const Mesh mesh = assemble_mesh(soup, box_patches(Vector::Zero(), Vector::Ones()));
  expect_sound(mesh);
  EXPECT_NEAR(mesh.cell_volume[0], 1.0, 1e-15);
}

TEST(Assembly, NonPlanarFaceIsTheSameForBothCells) {
  CellSoup soup = unit_cube_points();
  for (const double y : {0.0, 1.0})
    for (const double z : {0.0, 1.0}) soup.points.emplace_back(2.0, y, z);  // 8: y0 z0, 9: y0 z1, 10: y1 z0, 11: y1 z1
  add(soup, CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  add(soup, CellShape::hexahedron, {1, 8, 10, 2, 5, 9, 11, 6});
  soup.points[6][0] += 0.2;  // bends the face between them, and two faces of each
  const Mesh mesh = assemble_mesh(soup, {});
  expect_sound(mesh);
  EXPECT_NEAR(total_volume(mesh), 2.0, 1e-14);  // the point moves along faces of the outline
}

TEST(Assembly, RulesClaimInOrderAndTheRestAreWalls) {
  const auto everything = [](const Vector&, const Vector&, std::span<const Index>) { return true; };
  const auto top = plane_patch("top", 2, 1.0, 1e-9);
  const Mesh one = assemble_mesh(unit_cube(), {top, {"rest", everything}});
  EXPECT_EQ(one.patch("top").n_faces, 1);
  EXPECT_EQ(one.patch("rest").n_faces, 5);
  const Mesh two = assemble_mesh(unit_cube(), {top});
  EXPECT_EQ(two.patch("walls").n_faces, 5);
  const Mesh joined = assemble_mesh(unit_cube(), {top, plane_patch("top", 2, 0.0, 1e-9)});
  EXPECT_EQ(joined.patch("top").n_faces, 2);
  EXPECT_EQ(joined.patches.size(), 2U);
}

TEST(Assembly, RuleForNoFaceIsRefusedUnlessOptional) {
  PatchRule nowhere = plane_patch("load", 2, 7.0, 1e-9);
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(unit_cube(), {nowhere}); }), HasSubstr("\"load\""));
  nowhere.required = false;
  const Mesh mesh = assemble_mesh(unit_cube(), {nowhere});
  EXPECT_EQ(mesh.patches.size(), 1U);
}

TEST(Assembly, UnknownNamesAreAnsweredWithThoseThereAre) {
  const Mesh mesh = assemble_mesh(unit_cube(), {});
  EXPECT_THAT(message_of<InputError>([&] { mesh.patch("top"); }), HasSubstr("walls"));
  EXPECT_THAT(message_of<InputError>([&] { mesh.region_index("bead"); }), HasSubstr("body"));
}

TEST(Assembly, BadCellsAreRefused) {
  CellSoup flat = unit_cube_points();
  add(flat, CellShape::tetrahedron, {0, 1, 2, 3});
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(flat, {}); }), HasSubstr("cell 0"));

  CellSoup mirrored = unit_cube_points();
  add(mirrored, CellShape::tetrahedron, {0, 3, 1, 4});
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(mirrored, {}); }), HasSubstr("not positive"));

  CellSoup overlapping = unit_cube_points();
  overlapping.points.emplace_back(0.3, 0.2, 0.4);
  add(overlapping, CellShape::tetrahedron, {0, 1, 3, 4});
  add(overlapping, CellShape::tetrahedron, {0, 1, 3, 8});
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(overlapping, {}); }), HasSubstr("overlaps"));

  CellSoup crowded = unit_cube_points();
  for (const Index tip : {4, 5, 7}) add(crowded, CellShape::tetrahedron, {0, 1, 3, tip});
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(crowded, {}); }), HasSubstr("share one face"));

  CellSoup open = unit_cube_points();
  add(open, CellShape::polyhedron, {0, 1, 2, 3, 4, 5, 6, 7});
  open.polyhedron_faces = {{5, 4, 0, 1, 2, 3, 4, 4, 5, 6, 7, 4, 0, 4, 5, 1, 4, 3, 2, 6, 7, 4, 0, 4, 7, 3}};
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(open, {}); }), HasSubstr("do not close"));

  CellSoup stray = unit_cube_points();
  add(stray, CellShape::tetrahedron, {0, 1, 3, 99});
  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(stray, {}); }), HasSubstr("point that does not exist"));

  EXPECT_THAT(message_of<InputError>([&] { assemble_mesh(unit_cube_points(), {}); }), HasSubstr("no cells"));
}

TEST(ReverseCuthillMckee, ChainInRandomOrderGetsBandwidthOne) {
  // Cells 0..8 in a chain, visited in steps of 4 (mod 9); 9 and 10 are a component of their own.
  std::vector<std::pair<Index, Index>> neighbours;
  neighbours.reserve(9);
  for (Index i = 0; i < 8; ++i) neighbours.emplace_back(4 * i % 9, 4 * (i + 1) % 9);
  neighbours.emplace_back(10, 9);
  const std::vector<Index> order = reverse_cuthill_mckee(11, neighbours);
  std::vector<Index> place(11, -1);
  for (Index i = 0; i < 11; ++i) place[order[i]] = i;
  EXPECT_THAT(place, ::testing::Not(::testing::Contains(-1)));
  for (const auto& [a, b] : neighbours) EXPECT_EQ(std::abs(place[a] - place[b]), 1);
}

}  // namespace
}  // namespace pfdm::this_file
