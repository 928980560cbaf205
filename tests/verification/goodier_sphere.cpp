// A glass sphere in Sylgard under remote tension (Goodier 1933), exact displacement on a cube of half-width 4 R.

#include "physics/closed_forms/goodier.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace pfdm::verification {
namespace {

struct SphereErrors {
  Index cells = 0;
  double displacement = 0.0, matrix_stress = 0.0, pole = 0.0, energy = 0.0;
  Index iterations = 0;
  double cpu_seconds = 0.0;
};

SphereErrors sphere_errors(const Mesh& mesh, double ratio, double nu) {
  const double E = 75e6;
  const IsotropicElasticity glass = from_young_poisson(E * ratio, 0.3), matrix = from_young_poisson(E, nu);
  const Goodier exact(glass, matrix, 1.0, 1e6);
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : mesh.region_names) by_region.push_back(name == "bead" ? glass : matrix);
  const FractureModel model =
      elastic_model(by_region, displacement_on_all(mesh, [&](const Vector& x) { return exact.displacement(x); }));
  const auto solution = solve_elastic(mesh, model, {}, 1e-8);
  EXPECT_TRUE(solution->equilibrium.converged);
  const Index bead = mesh.region_index("bead");
  SphereErrors errors{.cells = mesh.n_cells(),
                      .iterations = solution->equilibrium.iterations,
                      .cpu_seconds = solution->cpu_seconds};
  errors.displacement = relative_error(
      mesh, [&](Index c) { return solution->u[as_size(c)]; },
      [&](Index c) { return exact.displacement(mesh.cell_centre[c]); }, [](Index) { return true; });
  const auto in_matrix = [&](Index c) { return mesh.region[c] != bead; };
  errors.matrix_stress = relative_stress_error(mesh, solution->cells.stress,
                                               [&](const Vector& x) { return exact.stress(x); }, in_matrix);
  double error = 0.0, size = 0.0, energy_error = 0.0, energy = 0.0;
  const MomentumOperator& balance = solution->solver->balance();
  for (const auto& [face, traction] : balance.interface_tractions(solution->u)) {
    const Vector n = mesh.face_area[face].normalized();
    if (std::abs(mesh.face_centre[face].normalized()[2]) < std::cos(15.0 * M_PI / 180.0)) continue;
    const double truth = exact.interface_normal_traction(mesh.face_centre[face].normalized()[2]);
    error += std::pow(traction.dot(n) - truth, 2);
    size += truth * truth;
  }
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!in_matrix(c)) continue;
    const double psi = energy_density(matrix, solution->cells.strain[c]);
    const double truth = energy_density(matrix, symmetric_part(exact.gradient(mesh.cell_centre[c])));
    energy_error += mesh.cell_volume[c] * std::pow(psi - truth, 2);
    energy += mesh.cell_volume[c] * truth * truth;
  }
  errors.pole = std::sqrt(error / size);
  errors.energy = std::sqrt(energy_error / energy);
  std::printf("%d cells, ratio %g, nu %g: u %.2e, matrix stress %.2e, pole %.2f %%, energy %.2e, %d iterations, %.2f CPU s\n",
              errors.cells, ratio, nu, errors.displacement, errors.matrix_stress, 100 * errors.pole, errors.energy,
              errors.iterations, errors.cpu_seconds);
  return errors;
}

TEST(GoodierSphere, ReportsMeshAtTwentyLayers) {
  const Mesh mesh = sphere_in_cube(std::getenv("N") ? std::atoi(std::getenv("N")) : 8, 20, 4.0, 0.4);
  const SphereErrors e = sphere_errors(mesh, 933.0, 0.44);
  EXPECT_LE(e.pole, 0.007);
  sphere_errors(mesh, 1e6, 0.44);
  sphere_errors(mesh, 933, 0.3);
  sphere_errors(mesh, 933, 0.49);
}

}  // namespace
}  // namespace pfdm::verification
