// A glass sphere in Sylgard under remote tension (Goodier 1933), exact displacement on a cube of half-width 4 R, or on
// a sphere of radius 4 R of which a sector is meshed.

#include "mesh/generators/sphere_sector.h"
#include "physics/closed_forms/goodier.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double half_width = 4.0;  // [R]

struct SphereCase {
  double ratio = 70e9 / 75e6;  // of Young's moduli
  double nu = 0.44;            // of the matrix
};

// All relative; the stress and the energy density are those of the matrix, the pole's error is that of the normal
// traction on the interface faces within 15 degrees of the axis.
struct SphereErrors {
  Index cells = 0, iterations = 0;
  double displacement = 0.0, stress = 0.0, energy = 0.0, pole = 0.0;
};

double pole_error(const Mesh& mesh, const ElasticSolution& solution, const Goodier& exact) {
  const double widest = 15.0 * std::numbers::pi / 180.0;
  double error = 0.0, size = 0.0;
  for (const auto& [face, traction] : solution.solver->balance().interface_tractions(solution.u)) {
    const double cosine = mesh.face_centre[face].normalized()[2];
    if (std::abs(cosine) < std::cos(widest)) continue;
    const double truth = exact.interface_normal_traction(cosine);
    error += std::pow(traction.dot(mesh.face_area[face].normalized()) - truth, 2);
    size += truth * truth;
  }
  return std::sqrt(error / size);
}

SphereErrors measure(const Mesh& mesh, const IsotropicElasticity& matrix, const ElasticSolution& solution,
                     const Goodier& exact) {
  const Index bead = mesh.region_index("bead");
  const auto in_matrix = [&](Index c) { return mesh.region[c] != bead; };
  const auto energy_vector = [&](const Tensor& strain) -> Vector {
    return energy_density(matrix, strain) * Vector::UnitX();
  };
  return {.cells = mesh.n_cells(),
          .iterations = solution.equilibrium.iterations,
          .displacement = displacement_error(mesh, solution, [&](const Vector& x) { return exact.displacement(x); }),
          .stress = relative_stress_error(
              mesh, solution.cells.stress, [&](const Vector& x) { return exact.stress(x); }, in_matrix),
          .energy = relative_error(
              mesh, [&](Index c) { return energy_vector(solution.cells.strain[c]); },
              [&](Index c) { return energy_vector(symmetric_part(exact.gradient(mesh.cell_centre[c]))); }, in_matrix),
          .pole = pole_error(mesh, solution, exact)};
}

std::vector<BoundaryCondition> boundary_of(const Mesh& mesh, const Goodier& exact) {
  const auto displacement = [exact](const Vector& x) { return exact.displacement(x); };
  if (mesh.patches.front().name != "front") return displacement_on_all(mesh, displacement);
  return {axisymmetric_on("front"), axisymmetric_on("back"), displacement_on("outer", displacement),
          displacement_on("inner", displacement)};
}

SphereErrors errors_of(const SphereCase& sphere, const Mesh& mesh) {
  const double E = 75e6;
  const IsotropicElasticity glass = from_young_poisson(E * sphere.ratio, 0.3),
                            matrix = from_young_poisson(E, sphere.nu);
  const Goodier exact(glass, matrix, 1.0, 1e6);
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : mesh.region_names) by_region.push_back(name == "bead" ? glass : matrix);
  const auto solution = solve_elastic(mesh, elastic_model(by_region, boundary_of(mesh, exact)), {}, 1e-8);
  EXPECT_TRUE(solution->equilibrium.converged);
  EXPECT_LE(energy_imbalance(mesh, *solution), 1e-6);
  const bool is_sector = mesh.patches.front().name == "front";  // whose two planes push it outwards
  EXPECT_LE(is_sector ? 0.0 : reaction_imbalance(mesh, *solution), 2e-6);
  const SphereErrors e = measure(mesh, matrix, *solution, exact);
  report_row(fmt::format("ratio {:.3g}, nu {}, {} cells", sphere.ratio, sphere.nu, e.cells),
             {{"u", e.displacement},
              {"stress", e.stress},
              {"energy", e.energy},
              {"pole", e.pole},
              {"iterations", solution->equilibrium.iterations},
              {"CPU s", solution->cpu_seconds}});
  return e;
}

// About 120,000 cells: twenty layers of prisms from R to 1.4 R.
class TwentyLayers : public testing::TestWithParam<double> {
 protected:
  static const Mesh& mesh() {
    static const Mesh of_all = sphere_in_cube(12, 20, half_width, 0.3);
    return of_all;
  }
};

TEST_P(TwentyLayers, MeetTheTargets) {
  const SphereErrors e = errors_of({.ratio = GetParam()}, mesh());
  EXPECT_NEAR(e.cells, 120000, 5000);
  EXPECT_LE(e.displacement, 7e-4);
  EXPECT_LE(e.stress, 1.3e-2);
  EXPECT_LE(e.pole, 0.7e-2);
  EXPECT_LE(e.iterations, 87);
}

INSTANTIATE_TEST_SUITE_P(GoodierSphere, TwentyLayers, testing::Values(70e9 / 75e6, 1e6));

TEST(GoodierSphere, WithoutLayersMeetsTheTarget) {
  const SphereErrors e = errors_of({}, sphere_in_cube(15, 0, half_width, 0.25));
  EXPECT_NEAR(e.cells, 120000, 5000);
  EXPECT_LE(e.displacement, 7e-4);
  EXPECT_LE(e.stress, 1.6e-2);
  EXPECT_LE(e.pole, 2.2e-2);
}

// Subdivision, number of layers and grading are refined together.
TEST(GoodierSphere, ConvergesAtSecondOrderInDisplacement) {
  std::vector<SphereErrors> e;
  for (const Index scale : {1, 2, 4})
    e.push_back(errors_of({}, sphere_in_cube(3 * scale, 5 * scale, half_width, 1.0 / scale)));
  const auto order = [&](double SphereErrors::*error) {
    return observed_order(e[1].*error, e[1].cells, e[2].*error, e[2].cells);
  };
  report_row("order between the finest two",
             {{"u", order(&SphereErrors::displacement)}, {"stress", order(&SphereErrors::stress)}});
  EXPECT_GE(order(&SphereErrors::displacement), 2.0);
  EXPECT_GE(order(&SphereErrors::stress), 0.9);
}

// On a mesh whose error at nu = 0.3 is given; the iterations may grow three and a half times (on meshes that differ by
// rounding 2.8 to 3.4 times, polyhedra).
void expect_no_locking(const Mesh& mesh, const SphereErrors& most) {
  const SphereErrors at_03 = errors_of({.nu = 0.3}, mesh);
  EXPECT_LE(at_03.pole, most.pole);
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const SphereErrors e = errors_of({.nu = nu}, mesh);
    EXPECT_LE(e.displacement, most.displacement);
    EXPECT_LE(e.stress, most.stress);
    EXPECT_LE(e.energy, most.energy);
    EXPECT_LE(e.pole, most.pole);
    EXPECT_LE(2 * e.iterations, 7 * at_03.iterations);
  }
}

TEST(GoodierSphere, DoesNotLockOnTetrahedraAndPrisms) {
  expect_no_locking(sphere_in_cube(9, 15, half_width, 0.33),
                    {.displacement = 7e-4, .stress = 1.5e-2, .energy = 1.5e-2, .pole = 1e-2});
}

// The pole's error is that of few faces: 2.1 or 2.8 % on two meshes that differ by rounding.
TEST(GoodierSphere, DoesNotLockOnTetrahedra) {
  expect_no_locking(sphere_in_cube(9, 0, half_width, 0.35),
                    {.displacement = 1.2e-3, .stress = 2.1e-2, .energy = 2e-2, .pole = 3e-2});
}

// One cell wide in azimuth, the exact displacement on the inner sphere as well.
Mesh sector(Index scale) {
  return make_sphere_sector(
      {.azimuth = std::numbers::pi / 36.0,
       .inner_radius = 0.5,
       .shells = {{{0.5, 6 * scale, 0.4}, "bead"}, {{half_width - 1.0, 12 * scale, 10.0}, "matrix"}},
       .polar = {{std::numbers::pi, 24 * scale, 1.0}}});
}

TEST(GoodierSphere, HoldsOnASector) {
  const SphereErrors coarse = errors_of({}, sector(1)), fine = errors_of({}, sector(2));
  EXPECT_LE(coarse.displacement, 3e-3);
  EXPECT_LE(coarse.stress, 3e-2);
  EXPECT_LE(fine.displacement, 0.31 * coarse.displacement);
  EXPECT_LE(fine.stress, 0.35 * coarse.stress);
  EXPECT_LE(fine.pole, 2e-2);
  EXPECT_LE(fine.iterations, 27);
}

// The dual of 46,000 tetrahedra and prisms.
class Polyhedra : public testing::Test {
 protected:
  static const Mesh& mesh() {
    static const Mesh dual = barycentric_dual(sphere_in_cube(8, 20, half_width, 0.4));
    return dual;
  }
};

TEST_F(Polyhedra, MeetTheTargets) {
  const SphereErrors e = errors_of({}, mesh());
  EXPECT_NEAR(e.cells, 17400, 500);
  EXPECT_LE(e.displacement, 1e-3);
  EXPECT_LE(e.stress, 1.3e-2);  // half of it in the thin curved half cells on the sphere
  EXPECT_LE(e.pole, 0.7e-2);
}

TEST(GoodierSphere, BeforeDualising) {
  const SphereErrors e = errors_of({}, sphere_in_cube(8, 20, half_width, 0.4));
  EXPECT_NEAR(e.cells, 45670, 1000);
  EXPECT_LE(e.displacement, 1.2e-3);
  EXPECT_LE(e.stress, 2e-2);
  EXPECT_LE(e.pole, 1e-2);
}

TEST(GoodierSphere, OnPolyhedraOfTenLayers) {
  const SphereErrors e = errors_of({}, barycentric_dual(sphere_in_cube(8, 10, half_width, 0.4)));
  EXPECT_NEAR(e.cells, 10984, 300);
  EXPECT_LE(e.displacement, 1.2e-3);
  EXPECT_LE(e.stress, 1.3e-2);
  EXPECT_LE(e.pole, 0.8e-2);
}

TEST_F(Polyhedra, DoNotLock) {
  expect_no_locking(mesh(), {.displacement = 1.2e-3, .stress = 1.5e-2, .energy = 3e-2, .pole = 1.2e-2});
}

}  // namespace
}  // namespace pfdm::verification::this_file
