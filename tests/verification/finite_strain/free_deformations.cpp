// Eigenstrains at finite strain: F = F_e F*, F* = 1 + eps*, with energies J* W(F_e). Closed forms: a free body, which
// has no stress; a body that is held everywhere, F_e = F*^-1; a plate between rollers. Spheres: swollen_spheres.cpp.

#include "mesh/generators/sphere_sector.h"
#include "physics/error.h"
#include "solver/fracture/combinations.h"
#include "tests/verification/finite.h"
#include "tests/verification/swollen_bodies.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::swollen_bodies;

// Over the shear modulus, and of F beyond F*.
void expect_free(const std::string& name, const Mesh& mesh, const FractureModel& model, const Tensor& strain) {
  const Swollen free = swell(mesh, model, 2);
  const double stress = largest(free.fields.stress) / model.regions[0].elasticity.mu;
  const double F = largest(free.fields.deformation_gradient, one + strain);
  report_row(name, {{"stress over mu", stress}, {"F", F}, {"energy", free.drawn.report.energy.elastic}});
  EXPECT_LT(stress, 1e-10 * (1.0 + model.regions[0].elasticity.lambda / (10.0 * soft.lambda))) << name;
  EXPECT_LT(F, 1e-10) << name;
  EXPECT_LT(free.drawn.report.energy.elastic, 1e-15 * model.regions[0].elasticity.mu) << name;
  EXPECT_LT(std::abs(free.drawn.report.energy.eigenstrain_work), 1e-12 * model.regions[0].elasticity.mu) << name;
}

// Three stretches; a shell of a sphere, of equal ones; a sheet that swells across.
TEST(FreeDeformations, LeaveAFreeBodyWithoutStress) {
  const Mesh tetrahedra = cube(), polyhedra = barycentric_dual(tetrahedra);
  const auto ogden = make_hyperelastic("ogden", {.elasticity = soft, .shares = {1.2, -0.2}, .exponents = {1.3, -2.0}});
  expect_free("tetrahedra and prisms", tetrahedra, swollen(tetrahedra, ogden, uneven, corner), uneven);
  expect_free("polyhedra", polyhedra, swollen(polyhedra, neo_hookean(soft), uneven, corner), uneven);
  expect_free("rubber", tetrahedra, swollen(tetrahedra, neo_hookean(rubber), uneven, corner), uneven);
  const Mesh shell = make_sphere_sector({.azimuth = 0.1,
                                         .inner_radius = 0.5,
                                         .shells = {{{0.5, 4, 1.0}, "body"}},
                                         .polar = {{std::numbers::pi / 2.0, 8, 1.0}}});
  for (const IsotropicElasticity& c : {soft, rubber})
    expect_free(c == soft ? "shell" : "shell of rubber", shell,
                swollen(shell, neo_hookean(c), even,
                        {axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("equator")}),
                even);
  const Mesh sheet = mapped_box({4, 3, 1}, [](const Vector& x) -> Vector { return x; });
  expect_free("sheet", sheet,
              swollen(sheet, neo_hookean(soft), uneven,
                      {symmetry_on("xmin"), symmetry_on("ymin"), plane_stress_on("zmin"), plane_stress_on("zmax")}),
              uneven);
}

// Held everywhere: F_e = F*^-1, stress J* P_e F*^-T; all that is stored comes from the eigenstrains.
TEST(FreeDeformations, OfABodyThatIsHeld) {
  const Mesh mesh = cube();
  const Tensor strain = (Tensor() << 0.12, 0.05, 0.0, 0.05, -0.04, 0.03, 0.0, 0.03, 0.08).finished();
  for (const IsotropicElasticity& c : {soft, from_young_poisson(1e6, 0.49)}) {
    const Tensor eps = c == soft ? strain : (0.2 * strain).eval();
    const auto material = neo_hookean(c);
    const auto none = [](const Vector&) -> Vector { return Vector::Zero(); };
    FractureModel model = swollen(mesh, material, eps, displacement_on_all(mesh, none));
    const Tensor F_e = (one + eps).inverse();
    const double J_e = F_e.determinant();
    // Of the neo-Hookean law by hand; the current volume is the reference's.
    const Tensor stress = c.mu / J_e * (F_e * F_e.transpose() - one) + c.lambda * (J_e - 1.0) * one;
    const double density =
        (0.5 * c.mu * (F_e.squaredNorm() - 3.0) - c.mu * std::log(J_e) + 0.5 * c.lambda * (J_e - 1.0) * (J_e - 1.0)) /
        J_e;
    std::vector<double> account;
    for (const Index steps : {5, 10}) {
      const Swollen held = swell(mesh, model, steps, c == soft ? 1e-12 : 1e-9);
      const double stored = held.drawn.report.energy.elastic;
      EXPECT_LT(largest(held.fields.stress, stress), 1e-10 * stress.norm());
      EXPECT_NEAR(stored, 64.0 * density, 1e-10 * 64.0 * density);
      account.push_back(held.drawn.report.energy.eigenstrain_work / stored - 1.0);
    }
    report_row(fmt::format("nu {}", c.poisson_ratio()), {{"work, 5 steps", account[0]}, {"10 steps", account[1]}});
    EXPECT_LT(std::abs(account[1]), 2e-3);
    EXPECT_LT(std::abs(account[1]), 0.3 * std::abs(account[0]));  // the trapezoid
  }
}

// Of the neo-Hookean law by hand.
Tensor cauchy_stress(const IsotropicElasticity& c, const Tensor& F_e) {
  const double J = F_e.determinant();
  return c.mu / J * (F_e * F_e.transpose() - one) + c.lambda * (J - 1.0) * one;
}

// Points within the unit cube that are moved, those of its surface within it.
Vector crooked(const Vector& x) {
  const Vector wave(std::sin(9.0 * x.y() + 5.0 * x.z()), std::sin(7.0 * x.z() + 4.0 * x.x()),
                    std::sin(8.0 * x.x() + 3.0 * x.y()));
  const Vector within = x.cwiseProduct(Vector::Ones() - x);
  return x + 0.25 * within.cwiseProduct(wave);
}

std::vector<BoundaryCondition> rollers(const Mesh& mesh) {
  std::vector<BoundaryCondition> all;
  for (const Patch& patch : mesh.patches) all.push_back(symmetry_on(patch.name));
  return all;
}

// As is, its mean stress 14 mu at nu = 0.49 and 1,441 mu at 0.4999, which does no work in a body whose surface is held:
// pressures must act on faces that close every cell and are the same on both sides.
TEST(FreeDeformations, OfANearlyIncompressibleBodyThatIsHeldOrGlides) {
  const Tensor strain = 0.12 * one;
  const Mesh bead = cube();
  const std::vector<std::pair<const char*, Mesh>> meshes{
      {"hexahedra", mapped_box({3, 3, 3}, crooked)},
      {"tetrahedra", mapped_box({2, 2, 2}, crooked, BoxCells::tetrahedra)},
      {"prisms", mapped_box({3, 3, 3}, crooked, BoxCells::prisms)},
      {"tetrahedra around prisms", bead},
      {"polyhedra", barycentric_dual(bead)}};
  const auto none = [](const Vector&) -> Vector { return Vector::Zero(); };
  for (const auto& [name, mesh] : meshes)
    for (const double nu : {0.49, 0.4999})
      for (const bool glides : {false, true}) {
        const IsotropicElasticity c = from_young_poisson(1e6, nu);
        const Tensor exact = cauchy_stress(c, (one + strain).inverse());
        const FractureModel model =
            swollen(mesh, neo_hookean(c), strain, glides ? rollers(mesh) : displacement_on_all(mesh, none));
        const Swollen held = swell(mesh, model, 5, 1e-8);
        const double wrong = largest(held.fields.stress, exact) / exact.norm();
        report_row(fmt::format("{}, nu {}, {}", name, nu, glides ? "rollers" : "held"), {{"stress", wrong}});
        EXPECT_LT(wrong, 1e-5) << name;  // prisms on rollers 5e-6, others at most 3e-8
      }
}

// Two layers between rollers, of which the first swells. F = diag(a, 1, 1) there and diag(2 - a, 1, 1) in the other.
// Prisms with next to no volume change bear less: at 3 % the layers bulge into each other.
TEST(FreeDeformations, OfALayerBesideAnother) {
  const IsotropicElasticity stiff = from_young_poisson(3e9, 0.3);
  const std::pair<BoxCells, double> cases[] = {
      {BoxCells::hexahedra, 1.12}, {BoxCells::tetrahedra, 1.09}, {BoxCells::prisms, 1.01}};
  for (const auto& [cells, s] : cases)
    for (const IsotropicElasticity& other : {stiff, from_young_poisson(3e6, 0.4995)}) {
      Mesh mesh = mapped_box(
          {2, 2, 2}, [](const Vector& x) -> Vector { return x; }, cells);
      mesh.region_names.emplace_back("other");
      for (Index c = 0; c < mesh.n_cells(); ++c) mesh.region[c] = mesh.cell_centre[c].x() > 0.5 ? 1 : 0;
      FractureModel model = swollen(mesh, neo_hookean(rubber), (s - 1.0) * one, rollers(mesh));
      model.regions[1].elasticity = other;
      model.regions[1].material = neo_hookean(other);
      model.regions[1].eigenstrain = given(Tensor::Zero());
      const auto stress_at = [&, swelling = s](double a, bool swells) {
        const Tensor F = Vector(swells ? a : 2.0 - a, 1.0, 1.0).asDiagonal();
        return cauchy_stress(swells ? rubber : other, swells ? (F / swelling).eval() : F);
      };
      double low = 1.0, high = 1.5;
      for (int n = 0; n < 100; ++n) {
        const double a = 0.5 * (low + high);
        (stress_at(a, true)(0, 0) < stress_at(a, false)(0, 0) ? low : high) = a;
      }
      const Swollen found = swell(mesh, model, 5, 1e-9);
      double wrong = 0.0;
      for (Index c = 0; c < mesh.n_cells(); ++c) {
        const Tensor exact = stress_at(low, mesh.region[c] == 0);
        wrong = std::max(wrong, (found.fields.stress[c] - exact).norm() / exact.norm());
      }
      report_row(fmt::format("cells {}, beside nu {}", static_cast<int>(cells), other.poisson_ratio()),
                 {{"stretch", low}, {"stress over mu", stress_at(low, true)(0, 0) / rubber.mu}, {"error", wrong}});
      EXPECT_LT(wrong, 1e-6);
    }
}

// A block that shrinks, held everywhere, AT2: psi = J* W(F*^-1) drives, d = 2 psi ell/(Gc + 2 psi ell).
TEST(FreeDeformations, OfABodyThatIsHeldDriveDamage) {
  const Mesh mesh = mapped_box({3, 2, 2}, [](const Vector& x) -> Vector { return x; });
  constexpr double s = 0.85, Gc = 3e5, ell = 1.0;
  FractureModel model = swollen(mesh, neo_hookean(soft), (s - 1.0) * one,
                                displacement_on_all(mesh, [](const Vector&) -> Vector { return Vector::Zero(); }));
  model.regions[0].damageable = true;
  model.regions[0].Gc = Gc, model.regions[0].ell = ell;
  model.residual_stiffness = 1e-9;
  const double l = 1.0 / s, J_e = l * l * l;
  const double psi =
      s * s * s *
      (1.5 * soft.mu * (l * l - 1.0) - soft.mu * std::log(J_e) + 0.5 * soft.lambda * (J_e - 1.0) * (J_e - 1.0));
  const double d = 2.0 * psi * ell / (Gc + 2.0 * psi * ell), g = (1.0 - d) * (1.0 - d);
  const Swollen held = swell(mesh, model, 10, 1e-10);
  double wrong = 0.0;
  for (const double found : held.drawn.state.damage) wrong = std::max(wrong, std::abs(found - d));
  const EnergyAccount& energy = held.drawn.report.energy;
  const double account = left_over({}, energy) / supplied(energy);
  report_row("shrunk by 15 %",
             {{"d", d}, {"error", wrong}, {"stored", energy.elastic / (g * psi) - 1.0}, {"account", account}});
  EXPECT_GT(d, 0.2);
  EXPECT_LT(wrong, 2e-4);  // the tolerance of the damage is 1e-4
  EXPECT_NEAR(energy.elastic, g * psi, 1e-3 * psi);
  EXPECT_LT(std::abs(account), 5e-3);
}

// A plate in plane strain that is free within its plane: P_yy = 0 and no strain across it; F_e by hand.
TEST(FreeDeformations, OfAPlateThatIsHeldAcross) {
  const Mesh mesh = mapped_box({4, 3, 1}, [](const Vector& x) -> Vector { return x; });
  constexpr double s = 1.2, k = 1.0 / s;  // the elastic stretch across
  const auto lateral = [&](double l) {    // stress of the neo-Hookean law along a free direction, over l
    return soft.mu * (l - 1.0 / l) + soft.lambda * (l * l * k - 1.0) * l * k;
  };
  double low = 0.9, high = 1.3;
  for (int n = 0; n < 100; ++n) (lateral(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  const double J_e = low * low * k, stress = (soft.mu * (k * k - 1.0)) / J_e + soft.lambda * (J_e - 1.0);
  const FractureModel model = swollen(mesh, neo_hookean(soft), (s - 1.0) * one,
                                      {symmetry_on("xmin"), symmetry_on("ymin"), plane_on("zmin"), plane_on("zmax")});
  const Swollen free = swell(mesh, model, 20);
  const Tensor exact = stress * Vector::UnitZ() * Vector::UnitZ().transpose();
  const EnergyAccount& energy = free.drawn.report.energy;
  report_row("plate", {{"stress", largest(free.fields.stress, exact) / -stress},
                       {"account", left_over({}, energy) / energy.elastic}});
  EXPECT_LT(largest(free.fields.stress, exact), -1e-10 * stress);
  EXPECT_LT(largest(free.fields.deformation_gradient, Vector(s * low, s * low, 1.0).asDiagonal()), 1e-10);
  EXPECT_LT(std::abs(left_over({}, energy)), 1e-3 * energy.elastic);
}

TEST(FreeDeformations, ThatTurnCellsInsideOutAreRefused) {
  const Mesh mesh = mapped_box({1, 1, 1}, [](const Vector& x) -> Vector { return x; });
  const FractureModel model = swollen(mesh, neo_hookean(soft), -0.6 * one, corner);
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  try {
    require_combination(mesh, model, unknowns, {.stops = {}});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("shrinks the free body to 0.475 of its length at the load 0.875"));
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
