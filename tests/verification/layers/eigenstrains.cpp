// Eigenstrains, as of thermal expansion. A uniform eigenstrain E with displacements u on the surface makes the stress
// of the body without it under u - E x: for every cell, split and damage.

#include "mesh/generators/sphere_sector.h"
#include "physics/materials/hyperelastic.h"
#include "tests/verification/bar.h"
#include "tests/verification/layers/eigenstrain_bodies.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

const Tensor slope = (Tensor() << 1.0, 0.3, 0.0, 0.1, -0.7, 0.0, 0.0, 0.0, 0.6).finished() * 1e-3;

struct Problem {
  std::string name;
  Mesh mesh;
  std::vector<IsotropicElasticity> materials;  // by region
  std::vector<std::string> held;               // patches whose displacement is prescribed
  std::vector<BoundaryCondition> sides;        // conditions on the others
  Tensor slope, eigenstrain;
  std::string split = "none";
  bool has_damage = false;
};

FractureModel model_of(const Problem& problem, bool with_eigenstrain) {
  FractureModel model = elastic_model(problem.materials, problem.sides);
  model.split = energy_split(problem.split);
  for (RegionModel& region : model.regions) {
    if (problem.has_damage) region.damageable = true;
    region.Gc = region.ell = 1.0;
  }
  const Tensor strain = problem.eigenstrain, moved = with_eigenstrain ? problem.slope : Tensor(problem.slope - strain);
  const auto eigenstrain = given(strain);
  if (with_eigenstrain)
    for (RegionModel& region : model.regions) region.eigenstrain = eigenstrain;
  for (const std::string& patch : problem.held)
    model.boundary.push_back(displacement_on(patch, [moved](const Vector& x) -> Vector { return moved * x; }));
  return model;
}

void expect_same_stress(const Problem& problem) {
  const CellField<double> damage =
      problem.has_damage ? some_damage(problem.mesh) : CellField<double>(problem.mesh.n_cells(), 0.0);
  const Answer with = equilibrium(problem.mesh, model_of(problem, true), damage);
  const Answer without = equilibrium(problem.mesh, model_of(problem, false), damage);
  double stress = 0.0, driving = 0.0, stored = 0.0;
  for (Index c = 0; c < problem.mesh.n_cells(); ++c) {
    stress = std::max(stress, (with.cells.stress[c] - without.cells.stress[c]).norm());
    driving = std::max(driving, std::abs(with.driving[c] - without.driving[c]));
    stored = std::max(stored, std::abs(with.stored[c] - without.stored[c]));
  }
  stress /= largest(without.cells.stress);
  driving /= *std::max_element(without.driving.begin(), without.driving.end());
  stored /= *std::max_element(without.stored.begin(), without.stored.end());
  report_row(problem.name, {{"stress", stress}, {"driving energy", driving}, {"stored energy", stored}});
  EXPECT_LT(stress, 1e-8) << problem.name;
  EXPECT_LT(driving, 1e-8) << problem.name;
  EXPECT_LT(stored, 1e-8) << problem.name;
}

const std::vector<std::string> six{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

Mesh plate(Index along, Index across, double length = 1.0) {
  BoxHexesSettings box;
  box.axes[0] = {{length, along, 2.0}};
  box.axes[1] = {{1.0, across, 1.0}};
  box.axes[2] = {{0.2, 1, 1.0}};
  box.regions = {{.name = "right", .lower = {0.4 * length, -1.0, -1.0}, .upper = {2.0 * length, 2.0, 1.0}}};
  return make_box_hexes(box);
}

Tensor general_strain() { return (Tensor() << 1.2, 0.4, -0.3, 0.4, 0.5, 0.2, -0.3, 0.2, -0.9).finished() * 1e-3; }

// Within the plane, and across it.
Tensor plane_strain_of(double across) {
  Tensor strain = general_strain();
  strain.row(2).setZero();
  strain.col(2).setZero();
  strain(2, 2) = across;
  return strain;
}

TEST(Eigenstrains, ActAsDisplacementsOfTheSurfaceOnTetrahedraPrismsAndPolyhedra) {
  for (const bool dual : {false, true})
    for (const bool soft : {false, true}) {
      const Mesh mesh = sphere_in_cube(1, 2, 2.0, 0.6);
      Problem problem{.name = fmt::format("{}{}", dual ? "polyhedra" : "tetrahedra and prisms", soft ? ", rubber" : ""),
                      .mesh = dual ? barycentric_dual(mesh) : mesh,
                      .materials = {glass, soft ? rubber : epoxy},
                      .held = six,
                      .sides = {},
                      .slope = slope,
                      .eigenstrain = general_strain(),
                      .has_damage = true};
      problem.materials.resize(problem.mesh.region_names.size(), problem.materials.back());
      if (soft) {  // a free side, or the change of volume times lambda would be all of it
        problem.held = {"xmin", "xmax", "ymin", "ymax", "zmin"};
        problem.has_damage = false;
      }
      if (soft) continue;
      expect_same_stress(problem);
    }
}

TEST(Eigenstrains, ActAsDisplacementsOfTheSurfaceInPlates) {
  for (const bool plane_stress : {false, true})
    for (const SplitLaw& law : energy_splits()) {
      if (law.parameters.size() > 0) continue;
      const auto side = plane_stress ? plane_stress_on : plane_on;
      expect_same_stress({.name = fmt::format("{}, {}", law.name, plane_stress ? "plane stress" : "plane strain"),
                          .mesh = plate(8, 6),
                          .materials = {glass, epoxy},
                          .held = {"xmin", "xmax", "ymin", "ymax"},
                          .sides = {side("zmin"), side("zmax")},
                          .slope = plane_strain_of(0.0) - Tensor(slope.topLeftCorner<3, 3>() * 0.0),
                          .eigenstrain = -0.6 * plane_strain_of(plane_stress ? 4e-4 : 0.0),
                          .split = std::string(law.name),
                          .has_damage = true});
    }
}

TEST(Eigenstrains, ActAsDisplacementsOfTheSurfaceInBeamsWithCubicFaces) {
  expect_same_stress({.name = "8 x 4 cells, 5 x 1",
                      .mesh = plate(8, 4, 5.0),
                      .materials = {glass, epoxy},
                      .held = {"xmin", "xmax", "ymin"},
                      .sides = {plane_on("zmin"), plane_on("zmax")},
                      .slope = Tensor::Zero(),
                      .eigenstrain = plane_strain_of(0.0),
                      .has_damage = false});
}

}  // namespace
}  // namespace pfdm::verification::this_file
