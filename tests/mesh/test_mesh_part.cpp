#include "mesh/mesh_part.h"
#include "mesh/particles_in_box.h"
#include "tests/mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm {
namespace {

Mesh sphere_in_box() {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-2.0);
  settings.upper = Vector::Constant(2.0);
  settings.particles = {{.radius = 1.0, .subdivision = 3, .n_layers = 3, .layer_thickness = 0.3}};
  return make_particles_in_box(settings);
}

std::vector<Index> cells_above(const Mesh& mesh, double height) {
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].z() > height) cells.push_back(c);
  return cells;
}

TEST(MeshPart, IsAMeshOfItsCells) {
  const Mesh whole = sphere_in_box();
  const std::vector<Index> cells = cells_above(whole, 0.3);
  MeshPart part = part_of(whole, cells);
  EXPECT_EQ(part.cell, cells);
  EXPECT_EQ(part.cut_patch().name, "cut");
  for (Index c = 0; c < part.mesh.n_cells(); ++c) {
    const Index there = part.cell[as_size(c)];
    EXPECT_EQ(part.mesh.cell_centre[c], whole.cell_centre[there]);
    EXPECT_EQ(part.mesh.region[c], whole.region[there]);
    EXPECT_EQ(part.mesh.faces_of_cell(c).size(), whole.faces_of_cell(there).size());
  }
  for (Index f = 0; f < part.mesh.n_faces(); ++f)
    EXPECT_EQ(part.mesh.face_centre[f], whole.face_centre[part.face[as_size(f)]]);
  std::erase_if(part.mesh.patches, [](const Patch& patch) { return patch.n_faces == 0; });
  expect_sound(part.mesh);
  const Vector cut = patch_area(part.mesh, "cut"), top = patch_area(part.mesh, "zmax");
  EXPECT_NEAR(cut.z(), -top.z(), 1e-10 * top.z());
}

TEST(MeshPart, LeavesNoCutWhereItIsTheWhole) {
  const Mesh whole = sphere_in_box();
  const MeshPart part = part_of(whole, cells_above(whole, -10.0));
  EXPECT_EQ(part.cut_patch().n_faces, 0);
  EXPECT_EQ(part.mesh.owner, whole.owner);
  EXPECT_EQ(part.mesh.neighbour, whole.neighbour);
  EXPECT_EQ(part.mesh.cell_faces, whole.cell_faces);
  EXPECT_EQ(part.mesh.face_area, whole.face_area);
}

TEST(MeshPart, TakesValuesOutAndPutsThemBack) {
  CellField<double> whole(std::vector<double>{0.0, 1.0, 2.0, 3.0});
  const std::vector<Index> cells{1, 3};
  CellField<double> part = take_out(whole, cells);
  EXPECT_EQ(part.values(), (std::vector<double>{1.0, 3.0}));
  part[1] = 7.0;
  put_back(part, cells, whole);
  EXPECT_EQ(whole.values(), (std::vector<double>{0.0, 1.0, 2.0, 7.0}));
  EXPECT_EQ(take_out(CellField<double>(), cells).size(), 0);
}

}  // namespace
}  // namespace pfdm
