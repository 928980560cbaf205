// Energy splits in the balance of momentum at given damage: plates in tension, compression and shear against the law of
// one point, and the full-tensor traction operator against the isotropic one. Cracks: closed_cracks.cpp.

#include "tests/verification/damage/split_plates.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

struct Halves {
  Mesh mesh;
  std::size_t upper, lower;  // regions
};

Halves two_halves() {
  Mesh mesh = make_box_hexes({.axes = {{{{1.0, 3, 1.0}}, {{1.0, 4, 1.0}}, {{0.3, 1, 1.0}}}},
                              .regions = {{.name = "lower", .lower = Vector(-1, -1, -1), .upper = Vector(2, 0.5, 1)}},
                              .base_region = "upper",
                              .slits = {}});
  const std::size_t upper = mesh.region_index("upper"), lower = as_size(mesh.region_index("lower"));
  return {std::move(mesh), upper, lower};
}

// Side by side and pressed along x without Poisson's effect: each half follows its own split and degradation.
TEST(EnergySplits, RegionsMayDifferInSplitAndDegradation) {
  const IsotropicElasticity cork = from_young_poisson(1e9, 0.0);
  constexpr double d = 0.6, x = 1.0 - d;
  const Tensor eps = -1e-3 * Vector::UnitX() * Vector::UnitX().transpose();
  const auto [mesh, upper, lower] = two_halves();
  const auto with_residual = [](double g) { return (1.0 - residual_stiffness) * g + residual_stiffness; };
  for (const char* split : {"spectral", "no_tension", "none"}) {
    SCOPED_TRACE(split);
    FractureModel model = damaged_model(
        energy_split("none"), displacement_on_all(mesh, [&](const Vector& at) -> Vector { return eps * at; }));
    model.regions.assign(2, {.elasticity = cork, .Gc = 1.0, .ell = 1.0});
    model.regions[lower].degradation = Degradation(degradation_law("cubic"), {0.5});
    model.regions[lower].split = energy_split(split);
    const Equilibrated on = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), d));
    const double cubic = 0.5 * (x * x * x - x * x) + 3.0 * x * x - 2.0 * x * x * x;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const bool is_lower = as_size(mesh.region[c]) == lower;
      const double kept = !is_lower ? with_residual(x * x) : std::string(split) == "none" ? with_residual(cubic) : 1.0;
      EXPECT_NEAR(on.cells.stress[c](0, 0), kept * 1e9 * eps(0, 0), 1e-3);
    }
  }
}

// One half has isotropic secant moduli, the other a tangent: under hydrostatic pressure both close, and are as if
// sound.
TEST(EnergySplits, RegionsMayDifferInTheKindOfSplit) {
  const auto [mesh, upper, lower] = two_halves();
  const Tensor eps = -1e-3 * Tensor::Identity();
  FractureModel model = damaged_model(energy_split("spectral"),
                                      displacement_on_all(mesh, [&](const Vector& at) -> Vector { return eps * at; }));
  model.regions.assign(2, {.elasticity = steel, .Gc = 1.0, .ell = 1.0});
  model.regions[lower].split = energy_split("volumetric_deviatoric");
  const Equilibrated on = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), 0.9));
  for (Index c = 0; c < mesh.n_cells(); ++c)
    EXPECT_LE((on.cells.stress[c] - stress(steel, eps)).norm(), 1e-8 * stress(steel, eps).norm());
}

// A plate, and a single cell, under a homogeneous strain: stress and energy are those of the law, in tension,
// compression and shear either way, and mixtures of them.
TEST(EnergySplits, AHomogeneousPlateFollowsTheLaw) {
  Tensor tension = Tensor::Zero(), shear = Tensor::Zero(), mixed = Tensor::Zero();
  tension.diagonal() << 1e-3, -2e-4, 4e-4;
  shear(0, 1) = shear(1, 0) = 1e-3;
  mixed << 1e-3, 6e-4, -2e-4, 6e-4, -8e-4, 3e-4, -2e-4, 3e-4, -5e-4;
  constexpr double d = 0.9, g = (1.0 - residual_stiffness) * (1.0 - d) * (1.0 - d) + residual_stiffness;
  double of_stress = 0.0, of_energy = 0.0;  // largest errors
  for (const SplitLaw& law : energy_splits()) {
    if (!law.variational) continue;
    SCOPED_TRACE(law.name);
    const EnergySplit split(law, {2.0});
    for (const Index n : {1, 3})
      for (const Tensor& strain : {tension, Tensor(-tension), shear, Tensor(-shear), mixed, Tensor(-mixed)}) {
        const Mesh mesh = plate(n);
        const FractureModel model =
            damaged_model(split, displacement_on_all(mesh, [&](const Vector& x) -> Vector { return strain * x; }));
        const Equilibrated on = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), d));
        const Tensor expected = degraded_stress(split, steel, g, strain);
        const auto [plus, minus] = split.energy(steel, strain);
        of_energy = std::max(of_energy, std::abs(on.energy - (g * plus + minus)) / (plus + minus));
        for (Index c = 0; c < mesh.n_cells(); ++c)
          of_stress = std::max(of_stress, (on.cells.stress[c] - expected).norm() / stress(steel, strain).norm());
        EXPECT_LE(of_energy, 1e-12);
        EXPECT_LE(of_stress, 3e-11);
      }
  }
  report_row("homogeneous plates", {{"stress", of_stress}, {"energy", of_energy}});
}

// The strain across a plate in plane stress, by bisection.
double strain_across(const EnergySplit& split, double g, Tensor strain) {
  double low = -1.0, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    strain(2, 2) = 0.5 * (low + high);
    (degraded_stress(split, steel, g, strain)(2, 2) < 0.0 ? low : high) = strain(2, 2);
  }
  return 0.5 * (low + high);
}

// The same in plane stress: whatever the split keeps, the strain across is the one at which nothing acts there, and
// drives as well.
TEST(EnergySplits, AHomogeneousPlateInPlaneStressFollowsTheLaw) {
  Tensor tension = Tensor::Zero(), shear = Tensor::Zero(), mixed = Tensor::Zero();
  tension.diagonal() << 1e-3, -2e-4, 0.0;
  shear(0, 1) = shear(1, 0) = 1e-3;
  mixed << 1e-3, 6e-4, 0.0, 6e-4, -8e-4, 0.0, 0.0, 0.0, 0.0;
  constexpr double d = 0.9, g = (1.0 - residual_stiffness) * (1.0 - d) * (1.0 - d) + residual_stiffness;
  double of_stress = 0.0, of_strain = 0.0, of_energy = 0.0, of_driving = 0.0;  // largest errors
  for (const SplitLaw& law : energy_splits()) {
    SCOPED_TRACE(law.name);
    const EnergySplit split(law, {2.0});
    for (const Tensor& in_plane : {tension, Tensor(-tension), shear, mixed, Tensor(-mixed)}) {
      Tensor strain = in_plane;
      strain(2, 2) = strain_across(split, g, in_plane);
      const Mesh mesh = plate(3);
      std::vector<BoundaryCondition> boundary{plane_stress_on("zmin"), plane_stress_on("zmax")};
      for (const char* side : {"xmin", "xmax", "ymin", "ymax"})
        boundary.push_back(displacement_on(side, [&](const Vector& x) -> Vector { return in_plane * x; }));
      const FractureModel model = damaged_model(split, boundary);
      const Equilibrated on = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), d));
      const Tensor expected = degraded_stress(split, steel, g, strain);
      const auto stiffness = make_cell_stiffness(mesh, model);
      const double driving = split.energy(steel, strain).psi_plus;
      const double whole = energy_density(steel, strain);
      of_energy = std::max(of_energy, std::abs(on.energy - 0.5 * contract(expected, strain)) / whole);
      for (Index c = 0; c < mesh.n_cells(); ++c) {
        of_stress = std::max(of_stress, (on.cells.stress[c] - expected).norm() / stress(steel, strain).norm());
        of_strain = std::max(of_strain, (on.cells.strain[c] - strain).norm() / strain.norm());
        of_driving = std::max(of_driving, std::abs(stiffness->driving_energy(c, on.cells, on.state) - driving) / whole);
      }
      EXPECT_LE(of_energy, 2e-10);
      EXPECT_LE(of_stress, 8e-9);
      EXPECT_LE(of_strain, 1e-8);
      EXPECT_LE(of_driving, 1e-8);
    }
  }
  report_row("plane stress",
             {{"stress", of_stress}, {"strain", of_strain}, {"energy", of_energy}, {"driving energy", of_driving}});
}

// Isotropic stiffness, of cells of any damage, as full tensors: the same forces, strains and stresses.
TEST(EnergySplits, TheFullTensorOperatorContainsTheIsotropicOne) {
  const Mesh mesh = rotated(extruded_triangles(5, {0.0, 0.2, 0.5, 1.0}), arbitrary_rotation());
  const auto field = [](const Vector& x) -> Vector { return Vector(std::sin(x[1]), x[0] * x[2], std::cos(x[0])); };
  const FractureModel model = elastic_model({steel}, displacement_on_all(mesh, field));
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumOperator isotropic(mesh, unknowns), full(mesh, unknowns);
  const std::size_t n = mesh.n_cells();
  CellField<IsotropicElasticity> moduli(n);
  CellField<double> g(n);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    g[c] = std::pow(10.0, -6.0 * (c % 7) / 6.0);
    moduli[c] = {g[c] * steel.lambda, g[c] * steel.mu};
  }
  isotropic.set_moduli(moduli, g);
  std::vector<Vector> u(unknowns.n_unknowns()), one(u.size()), other(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto k = static_cast<Index>(i);
    u[i] = field(k < unknowns.n_cells ? mesh.cell_centre[k]
                                      : mesh.face_centre[unknowns.face_of_node[k - unknowns.n_cells]]);
  }
  const StrainLaw law{
      .tangent = [&](Index c,
                     const Tensor& strain) { return degraded_tangent(energy_split("none"), steel, g[c], strain); },
      .degradable = {}};
  full.set_law(law, g, u, true);
  isotropic.apply(u, one);
  full.apply(u, other);
  double size = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i)
    size += one[i].squaredNorm(), difference += (one[i] - other[i]).squaredNorm();
  EXPECT_LE(std::sqrt(difference / size), 1e-12);
  const CellMechanics a = isotropic.mechanics(u), b = full.mechanics(u);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_LE((a.strain[c] - b.strain[c]).norm(), 1e-9 * a.strain[c].norm());
    EXPECT_LE((a.stress[c] - b.stress[c]).norm(), 1e-9 * steel.mu);
  }
  const BlockTriplets p = isotropic.compact_matrix(), q = full.compact_matrix();
  for (std::size_t i = 0; i < p.diagonal.size(); ++i)
    EXPECT_LE((p.diagonal[i] - q.diagonal[i]).norm(), 1e-10 * p.diagonal[i].norm());
}

}  // namespace
}  // namespace pfdm::verification::this_file
