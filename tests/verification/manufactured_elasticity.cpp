// A smooth displacement made up beforehand, on unstructured tetrahedra of a unit cube: orders of convergence.
//
//   u = sum_m A_m sin(k_m.x + phi_m),
//   f = -div sigma = sum_m [(lambda + mu) (A_m.k_m) k_m + mu |k_m|^2 A_m] sin(k_m.x + phi_m).

#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification {
namespace {

struct Wave {
  Vector amplitude;  // [m]
  Vector k;          // [1/m]
  double phase;
};

const std::vector<Wave> waves{{{1.0, 0.4, -0.3}, {2.6, 1.7, 0.8}, 0.3},
                              {{-0.2, 0.9, 0.5}, {-1.1, 2.2, 2.0}, 1.1},
                              {{0.5, -0.3, 0.8}, {1.5, -0.9, 3.0}, 2.0}};

template <class Term>
auto sum_of_waves(const Vector& x, const Term& term) {
  auto sum = term(waves[0], waves[0].k.dot(x) + waves[0].phase);
  for (std::size_t m = 1; m < waves.size(); ++m) sum += term(waves[m], waves[m].k.dot(x) + waves[m].phase);
  return sum;
}

Vector displacement(const Vector& x) {
  return sum_of_waves(x, [](const Wave& w, double at) -> Vector { return w.amplitude * std::sin(at); });
}

Tensor exact_stress(const IsotropicElasticity& c, const Vector& x) {
  return stress(c, symmetric_part(sum_of_waves(x, [](const Wave& w, double at) -> Tensor {
                  return w.amplitude * w.k.transpose() * std::cos(at);
                })));
}

Vector body_force(const IsotropicElasticity& c, const Vector& x) {
  return sum_of_waves(x, [&](const Wave& w, double at) -> Vector {
    return ((c.lambda + c.mu) * w.amplitude.dot(w.k) * w.k + c.mu * w.k.squaredNorm() * w.amplitude) * std::sin(at);
  });
}

Mesh tetrahedra(double size) {
  ParticlesInBoxSettings settings;
  settings.upper = Vector::Ones();
  settings.size_far = settings.boundary_size = size;
  return make_particles_in_box(settings);
}

struct Errors {
  Index cells = 0, iterations = 0;
  double displacement = 0.0, stress = 0.0;
};

Errors errors_on(const Mesh& mesh, double nu) {
  const IsotropicElasticity c = from_young_poisson(1.0, nu);
  const auto solution = solve_elastic(mesh, elastic_model({c}, displacement_on_all(mesh, displacement)), {}, 1e-8,
                                      [&](const Vector& x) { return body_force(c, x); });
  EXPECT_TRUE(solution->equilibrium.converged);
  const auto truth = [&](const Vector& x) { return exact_stress(c, x); };
  const Errors e{.cells = mesh.n_cells(),
                 .iterations = solution->equilibrium.iterations,
                 .displacement = displacement_error(mesh, *solution, displacement),
                 .stress = relative_stress_error(mesh, solution->cells.stress, truth, [](Index) { return true; })};
  report_row(
      fmt::format("nu {}, {} cells", nu, e.cells),
      {{"u", e.displacement}, {"stress", e.stress}, {"iterations", e.iterations}, {"CPU s", solution->cpu_seconds}});
  return e;
}

class ManufacturedElasticity : public testing::TestWithParam<double> {};

TEST_P(ManufacturedElasticity, ConvergesOnTetrahedra) {
  std::vector<Errors> e;
  for (const double size : {0.165, 0.1, 0.064}) e.push_back(errors_on(tetrahedra(size), GetParam()));
  const double order_u = observed_order(e[1].displacement, e[1].cells, e[2].displacement, e[2].cells);
  const double order_stress = observed_order(e[1].stress, e[1].cells, e[2].stress, e[2].cells);
  report_row("order between the finest two", {{"u", order_u}, {"stress", order_stress}});
  EXPECT_GE(order_u, 1.8);
  EXPECT_GE(order_stress, 0.9);
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, ManufacturedElasticity, testing::Values(0.3, 0.44, 0.49, 0.499));

TEST_P(ManufacturedElasticity, ConvergesOnPolyhedra) {
  std::vector<Errors> e;
  for (const double size : {0.165, 0.1, 0.064}) e.push_back(errors_on(barycentric_dual(tetrahedra(size)), GetParam()));
  const double order_u = observed_order(e[1].displacement, e[1].cells, e[2].displacement, e[2].cells);
  const double order_stress = observed_order(e[1].stress, e[1].cells, e[2].stress, e[2].cells);
  report_row("order between the finest two", {{"u", order_u}, {"stress", order_stress}});
  EXPECT_GE(order_u, 1.8);
  EXPECT_GE(order_stress, 0.9);
}

TEST(ManufacturedElasticity, TakesAtMostTwiceTheIterationsOf03At044) {
  const Mesh mesh = tetrahedra(0.064);
  EXPECT_LE(errors_on(mesh, 0.44).iterations, 2 * errors_on(mesh, 0.3).iterations);
}

}  // namespace
}  // namespace pfdm::verification
