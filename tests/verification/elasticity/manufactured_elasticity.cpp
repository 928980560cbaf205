// A smooth displacement made up beforehand, on unstructured tetrahedra of a unit cube: orders of convergence.
//
//   u = sum_m A_m sin(k_m.x + phi_m),
//   f = -div sigma = sum_m [(lambda + mu) (A_m.k_m) k_m + mu |k_m|^2 A_m] sin(k_m.x + phi_m).
//
// As nu -> 1/2 this force grows with lambda, and so does what its values at the cell centres make of it. Waves whose
// amplitude along k_m is mu/lambda of that keep stress and force bounded, as loads on a body do.

#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

struct Wave {
  Vector amplitude;  // [m]
  Vector k;          // [1/m]
  double phase;
};

const std::vector<Wave> waves{{{1.0, 0.4, -0.3}, {2.6, 1.7, 0.8}, 0.3},
                              {{-0.2, 0.9, 0.5}, {-1.1, 2.2, 2.0}, 1.1},
                              {{0.5, -0.3, 0.8}, {1.5, -0.9, 3.0}, 2.0}};

std::vector<Wave> bounded_waves(const IsotropicElasticity& c) {
  std::vector<Wave> bounded = waves;
  for (Wave& w : bounded) {
    const Vector along = w.amplitude.dot(w.k) / w.k.squaredNorm() * w.k;
    w.amplitude += (c.mu / c.lambda - 1.0) * along;
  }
  return bounded;
}

struct Manufactured {
  IsotropicElasticity c;
  std::vector<Wave> of = waves;

  auto sum(const Vector& x, const auto& term) const {
    auto total = term(of[0], of[0].k.dot(x) + of[0].phase);
    for (std::size_t m = 1; m < of.size(); ++m) total += term(of[m], of[m].k.dot(x) + of[m].phase);
    return total;
  }

  Vector displacement(const Vector& x) const {
    return sum(x, [](const Wave& w, double at) -> Vector { return w.amplitude * std::sin(at); });
  }

  Tensor stress(const Vector& x) const {
    return pfdm::stress(c, symmetric_part(sum(x, [](const Wave& w, double at) -> Tensor {
                          return w.amplitude * w.k.transpose() * std::cos(at);
                        })));
  }

  Vector body_force(const Vector& x) const {
    return sum(x, [&](const Wave& w, double at) -> Vector {
      return ((c.lambda + c.mu) * w.amplitude.dot(w.k) * w.k + c.mu * w.k.squaredNorm() * w.amplitude) * std::sin(at);
    });
  }
};

Mesh tetrahedra(double size) {
  ParticlesInBoxSettings settings;
  settings.upper = Vector::Ones();
  settings.size_far = settings.boundary_size = size;
  return make_particles_in_box(settings);
}

struct Errors {
  Index cells = 0, iterations = 0;
  double displacement = 0.0, stress = 0.0, pressure = 0.0;  // pressure: that of the mean stress, over the stress
};

Errors errors_on(const Mesh& mesh, double nu, const Manufactured& exact, std::vector<BoundaryCondition> boundary) {
  const auto displacement = [&](const Vector& x) { return exact.displacement(x); };
  const auto solution = solve_elastic(mesh, elastic_model({exact.c}, std::move(boundary)), {}, 1e-8,
                                      [&](const Vector& x) { return exact.body_force(x); });
  EXPECT_TRUE(solution->equilibrium.converged);
  const auto truth = [&](const Vector& x) { return exact.stress(x); };
  const auto everywhere = [](Index) { return true; };
  CellField<Tensor> with_its_mean(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Tensor of_exact = truth(mesh.cell_centre[c]);
    with_its_mean[c] = of_exact + (solution->cells.stress[c] - of_exact).trace() / 3.0 * Tensor::Identity();
  }
  const Errors e{.cells = mesh.n_cells(),
                 .iterations = solution->equilibrium.iterations,
                 .displacement = displacement_error(mesh, *solution, displacement),
                 .stress = relative_stress_error(mesh, solution->cells.stress, truth, everywhere),
                 .pressure = relative_stress_error(mesh, with_its_mean, truth, everywhere)};
  report_row(fmt::format("nu {}, {} cells", nu, e.cells), {{"u", e.displacement},
                                                           {"stress", e.stress},
                                                           {"pressure", e.pressure},
                                                           {"iterations", e.iterations},
                                                           {"CPU s", solution->cpu_seconds}});
  return e;
}

Errors errors_on(const Mesh& mesh, double nu) {
  const Manufactured exact{.c = from_young_poisson(1.0, nu)};
  return errors_on(mesh, nu, exact, displacement_on_all(mesh, [&](const Vector& x) { return exact.displacement(x); }));
}

// One side is pulled at: where all are held, the volume that the displacements at the faces' centres let in, not quite
// that of the exact ones, makes a pressure of lambda times as much.
Errors bounded_errors_on(const Mesh& mesh, double nu) {
  const IsotropicElasticity c = from_young_poisson(1.0, nu);
  const Manufactured exact{.c = c, .of = bounded_waves(c)};
  auto boundary = displacement_on_all(mesh, [&](const Vector& x) { return exact.displacement(x); });
  for (BoundaryCondition& side : boundary)
    if (side.patch == "xmax")
      side = traction_on("xmax", [&](const Vector& x) -> Vector { return exact.stress(x) * Vector::UnitX(); });
  return errors_on(mesh, nu, exact, std::move(boundary));
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
  EXPECT_LE(e[2].displacement, GetParam() > 0.495 ? 1e-2 : 4e-3);
  EXPECT_LE(e[2].stress, 0.03);
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, ManufacturedElasticity, testing::Values(0.3, 0.44, 0.49, 0.499));

TEST_P(ManufacturedElasticity, ConvergesOnPolyhedra) {
  std::vector<Errors> e;
  for (const double size : {0.165, 0.1, 0.064}) e.push_back(errors_on(barycentric_dual(tetrahedra(size)), GetParam()));
  const double order_u = observed_order(e[1].displacement, e[1].cells, e[2].displacement, e[2].cells);
  const double order_stress = observed_order(e[1].stress, e[1].cells, e[2].stress, e[2].cells);
  report_row("order between the finest two", {{"u", order_u}, {"stress", order_stress}});
  EXPECT_GE(order_u, 1.85);
  EXPECT_GE(order_stress, 1.25);
  EXPECT_LE(e[2].displacement, GetParam() > 0.495 ? 0.2 : 0.02);
  EXPECT_LE(e[2].stress, 0.01);
}

// The errors may not depend on nu, nor the iterations by more than a factor of three.
class NearlyIncompressible : public testing::TestWithParam<bool> {};

TEST_P(NearlyIncompressible, ConvergesWhateverPoissonsRatio) {
  const auto mesh_of = [&](double size) { return GetParam() ? barycentric_dual(tetrahedra(size)) : tetrahedra(size); };
  const Mesh coarse = mesh_of(0.1), fine = mesh_of(0.064);
  const Errors at_03 = bounded_errors_on(fine, 0.3);
  EXPECT_LE(at_03.displacement, GetParam() ? 6e-3 : 2.5e-3);
  EXPECT_LE(at_03.stress, GetParam() ? 0.011 : 0.04);
  EXPECT_LE(at_03.pressure, GetParam() ? 6e-3 : 0.011);
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const Errors e = bounded_errors_on(coarse, nu), f = bounded_errors_on(fine, nu);
    const double order_u = observed_order(e.displacement, e.cells, f.displacement, f.cells);
    const double order_stress = observed_order(e.stress, e.cells, f.stress, f.cells);
    report_row("order", {{"u", order_u}, {"stress", order_stress}});
    EXPECT_GE(order_u, 1.85);
    EXPECT_GE(order_stress, GetParam() ? 1.35 : 0.9);
    EXPECT_LE(f.displacement, 1.2 * at_03.displacement);
    EXPECT_LE(f.stress, 1.2 * at_03.stress);
    EXPECT_LE(f.pressure, 1.2 * at_03.pressure);
    EXPECT_LE(f.iterations, 2.5 * at_03.iterations);
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, NearlyIncompressible, testing::Bool(), [](const auto& test) {
  return test.param ? std::string("Polyhedra") : std::string("Tetrahedra");
});

TEST(ManufacturedElasticity, TakesAtMostTwiceTheIterationsOf03At044) {
  const Mesh mesh = tetrahedra(0.064);
  EXPECT_LE(errors_on(mesh, 0.44).iterations, 2 * errors_on(mesh, 0.3).iterations);
}

}  // namespace
}  // namespace pfdm::verification::this_file
