// The mean of the damage about the vertices of a cell: exact for linear fields, and its derivatives.

#include "physics/error.h"
#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/cracks/unit_toughness.h"
#include "tests/verification/near_field.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

BoxHexesSettings cube(Index n) {
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, n, 1.0}}, {{1.0, n, 1.0}}, {{1.0, n, 1.0}}}};
  return settings;
}

// Unit cubes and squares of every shape of cell; hexahedra three times as long at one end.
struct Shape {
  std::string name;
  Mesh mesh;
};

std::vector<Shape> meshes_of_every_shape() {
  ParticlesInBoxSettings settings;
  settings.upper = Vector::Ones();
  settings.boundary_size = settings.size_far = 0.2;
  Mesh tetrahedra = make_particles_in_box(settings), dual = barycentric_dual(tetrahedra);
  BoxHexesSettings graded = cube(6);
  graded.axes[0] = {{1.0, 6, 3.0}};
  return {{"hexahedra", make_box_hexes(graded)},
          {"prisms", extruded_triangles(8, {0.0, 0.12, 0.26, 0.4})},
          {"tetrahedra", std::move(tetrahedra)},
          {"polyhedra", std::move(dual)}};
}

TEST(VertexMeans, SpreadAsTheyAreTakenInEveryShape) {
  for (const auto& [name, mesh] : meshes_of_every_shape()) {
    std::vector<Index> cells;
    for (Index c = 0; c < mesh.n_cells(); ++c)
      if (c % 5 != 0) cells.push_back(c);
    const VertexMeans means(mesh, cells);
    CellField<double> v(mesh.n_cells()), w(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      v[c] = std::sin(3.0 * static_cast<double>(c));
      w[c] = std::cos(7.0 * static_cast<double>(c));
    }
    const CellField<double> of_v = means.of(v), of_w = means.spread(w);
    double left = 0.0, right = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      left += of_v[c] * w[c];
      right += v[c] * of_w[c];
    }
    EXPECT_NEAR(left, right, 1e-11) << name;
  }
}

// Exact for linear fields but at the surface; there for fields without a slope across it, of polyhedra within 3 % of
// what they vary by over a cell: their weights are limited.
TEST(VertexMeans, AreExactForLinearFieldsInEveryShape) {
  for (const auto& [name, mesh] : meshes_of_every_shape()) {
    std::vector<Index> cells(mesh.n_cells());
    std::iota(cells.begin(), cells.end(), 0);
    const VertexMeans means(mesh, cells);
    std::vector<char> on_side(mesh.points.size(), 0), on_z(mesh.points.size(), 0);
    for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
      for (const Index p : mesh.points_of_face(f))
        (std::abs(mesh.face_area[f].z()) > 0.9 * mesh.face_area[f].norm() ? on_z : on_side)[p] = 1;
    CellField<double> v(mesh.n_cells()), flat(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      v[c] = mesh.cell_centre[c].dot(Vector(0.2, 0.3, 0.4));
      flat[c] = mesh.cell_centre[c].dot(Vector(0.2, 0.3, 0.0));
    }
    const CellField<double> of_v = means.of(v), of_flat = means.of(flat);
    Index inner = 0, beside = 0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const auto is_on = [&](const std::vector<char>& surface) {
        return std::ranges::any_of(mesh.points_of_cell(c), [&](Index p) { return surface[p] != 0; });
      };
      if (is_on(on_side)) continue;
      EXPECT_NEAR(of_flat[c], flat[c], is_on(on_z) && name == "polyhedra" ? 2e-3 : 1e-13) << name;
      if (is_on(on_z)) {
        ++beside;
      } else {
        ++inner;
        EXPECT_NEAR(of_v[c], v[c], 1e-13) << name;
      }
    }
    EXPECT_GT(inner, 0) << name;
    EXPECT_GT(beside, 0) << name;
  }
}

// D and its derivatives, by differences.
TEST(MeanDamage, HasTheDerivativesItSays) {
  const Mesh mesh = make_box_hexes(cube(5));
  for (const std::string law : {"AT1", "AT2", "Wu"}) {
    FractureModel model = model_of(law, 0.6);
    model.stiffness_by = StiffnessBy::mean;
    const StiffnessDamage by(mesh, model, Vector::Zero());
    const auto middle = std::ranges::min_element(mesh.cell_centre.begin(), mesh.cell_centre.end(), {},
                                                 [](const Vector& x) { return (x - Vector::Constant(0.5)).norm(); });
    const auto c = static_cast<Index>(middle - mesh.cell_centre.begin());
    for (const double x : {0.1, 0.5, 0.8}) {
      constexpr double step = 1e-5;
      const auto before = by.at(c, x - step), at = by.at(c, x), after = by.at(c, x + step);
      EXPECT_NEAR(at.slope, (after.value - before.value) / (2.0 * step), 1e-6) << law;
      EXPECT_NEAR(at.curvature, (after.slope - before.slope) / (2.0 * step), 1e-5) << law;
    }
    EXPECT_EQ(by.at(c, 1.0).value, 1.0);
    EXPECT_LT(by.at(c, 0.1).value, 0.1 + 1e-4);
    EXPECT_EQ(by.at(0, 1.0).slope, 0.0);  // of a mean, at the surface too
  }
}

TEST(MeanDamage, IsRefusedWhereItHasNoEnergy) {
  const Mesh mesh = make_box_hexes(cube(4));
  FractureModel model = model_of("AT1", 0.5);
  model.regions[0].elasticity = from_young_poisson(1.0, 0.3);
  model.boundary = {displacement_on("xmin", [](const Vector&) { return Vector(Vector::Zero()); })};
  model.stiffness_by = StiffnessBy::mean;
  EXPECT_NO_THROW(FractureRun(mesh, model, {}, {}));
  FractureModel rankine = model, history = model;
  rankine.split = energy_split("rankine");
  history.irreversibility = Irreversibility::history;
  EXPECT_THROW(FractureRun(mesh, rankine, {}, {}), InputError);
  EXPECT_THROW(FractureRun(mesh, history, {}, {}), InputError);
}

}  // namespace
}  // namespace pfdm::verification::this_file
