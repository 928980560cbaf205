#include "mesh/geometry.h"
#include "postproc/cohesive/columns.h"
#include "solver/fracture/model/state.h"
#include "tests/postproc/boxes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::test::this_file {
namespace {

// A slender cone, two cells wide, around a sphere of radius 1 m: bead, band of 13 % of the radius, matrix.
Mesh cone(Index n_band_cells) {
  constexpr double half_angle = 1e-3;
  BoxHexesSettings box;
  box.origin = {0.5, -1.0, -1.0};
  box.axes = {{{{0.5, 2, 1.0}, {0.13, n_band_cells, 1.0}, {1.0, 2, 1.0}}, {{2.0, 2, 1.0}}, {{2.0, 1, 1.0}}}};
  box.base_region = "matrix";
  box.regions = {{.name = "bead", .lower = {0.0, -2.0, -2.0}, .upper = {1.0, 2.0, 2.0}},
                 {.name = "band", .lower = {1.0, -2.0, -2.0}, .upper = {1.13, 2.0, 2.0}}};
  Mesh mesh = make_box_hexes(box);
  for (Vector& x : mesh.points) x = x[0] * Vector(1.0, half_angle * x[1], half_angle * x[2]);
  compute_geometry(mesh);
  return mesh;
}

// Radial tractions of 1 Pa m^2/r^2: what a sphere without stress along its surface has.
OutputFields pulled(const Mesh& mesh) {
  const std::size_t n = mesh.n_cells();
  OutputFields output;
  output.damage = CellField<double>(n, 0.0);
  output.stress = output.strain = CellField<Tensor>(n, Tensor::Zero());
  output.fracture_energy_density = CellField<double>(n, 0.0);
  output.traction = FaceField<Vector>(mesh.n_faces(), Vector::Zero());
  for (Index f = 0; f < mesh.n_faces(); ++f) {
    const double x = mesh.face_centre[f].x();
    output.traction[f] = Vector(mesh.face_area[f].normalized().x() / (x * x), 0.0, 0.0);
  }
  return output;
}

FractureModel sound(const Mesh& mesh) {
  FractureModel model;
  model.regions.resize(mesh.region_names.size());
  return model;
}

void break_layer(const Mesh& mesh, OutputFields& output, double from, double to) {
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c].x() > from && mesh.cell_centre[c].x() < to) output.damage[c] = 0.9;
}

// Wherever the damage is, so that nothing jumps when it begins or moves.
TEST(Columns, take_the_traction_of_a_band_at_its_middle) {
  for (const Index n : {12, 13}) {
    const Mesh mesh = cone(n);
    const FractureModel model = sound(mesh);
    const ColumnSet set = interface_columns(mesh, "band", "matrix", Vector::UnitX()).front();
    ASSERT_EQ(set.columns.size(), 2u);
    const double expected = 1.0 / (1.065 * 1.065);
    OutputFields output = pulled(mesh);
    const double sound = sample_columns(mesh, model, output, set).front().traction[0];
    EXPECT_NEAR(sound, expected, 1e-3 * expected);
    for (const double at : {1.0, 1.11}) {
      break_layer(mesh, output, at, at + 0.02);
      const ColumnSample damaged = sample_columns(mesh, model, output, set).front();
      EXPECT_EQ(damaged.largest_damage, 0.9);
      EXPECT_EQ(damaged.traction[0], sound) << n << " cells, damage at " << at;
    }
  }
}

// Of columns that the boundary cuts short on one side too.
TEST(Columns, take_the_traction_of_a_plane_on_it) {
  const Mesh mesh = cone(13);
  const FractureModel model = sound(mesh);
  OutputFields output = pulled(mesh);
  for (const double half_width : {0.02, 0.2}) {
    const ColumnSet set =
        plane_columns(mesh, "cut", Vector(1.045, 0.0, 0.0), Vector::UnitX(), half_width, Vector::UnitX());
    for (const double at : {1.03, 1.05}) {
      break_layer(mesh, output, at, at + 0.01);
      const double expected = 1.0 / (1.045 * 1.045);
      EXPECT_NEAR(sample_columns(mesh, model, output, set).front().traction[0], expected, 1e-3 * expected);
    }
  }
}

}  // namespace
}  // namespace pfdm::test::this_file
