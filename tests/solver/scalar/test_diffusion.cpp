// Diffusion against closed forms: slabs with exchange at their sides, laminates, decay in time, non-linear sources.

#include "solver/scalar/diffusion.h"

#include "physics/error.h"

#include <cmath>
#include <numbers>

#include "tests/physics/physics_checks.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

using Kind = DiffusionBoundary::Kind;

CellField<double> uniform(const Mesh& mesh, double value) { return CellField<double>(mesh.n_cells(), value); }

template <class Exact>
double largest_error(const Mesh& mesh, const CellField<double>& u, const Exact& exact) {
  double error = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) error = std::max(error, std::abs(u[c] - exact(mesh.cell_centre[c])));
  return error;
}

// A plate of a binder, heated within and cooled by convection, unequally on its two sides:
// T = -q x^2/(2 k) + a x + b with k a = h1 (b - T1) at x = 0 and -k T'(L) = h2 (T(L) - T2).
TEST(Diffusion, SlabWithExchangeOnBothSides) {
  constexpr double k = 0.27, q = 3000.0, L = 0.0127, h1 = 8.0, h2 = 25.0, T1 = 293.0, T2 = 301.0;
  const double a = (h2 * (q * L * L / (2.0 * k) + T2 - T1) + q * L) / (k + h2 * (L + k / h1)), b = T1 + k * a / h1;
  const auto exact = [&](const Vector& x) { return -q * x[0] * x[0] / (2.0 * k) + a * x[0] + b; };
  std::vector<double> errors;
  for (const Index n : {10, 20}) {
    const Mesh mesh = box(n, 2, 3, {L, 0.01, 0.02});
    Diffusion diffusion(mesh, {.conductivity = uniform(mesh, k),
                               .boundary = {{.patch = "xmin", .kind = Kind::exchange, .value = T1, .coefficient = h1},
                                            {.patch = "xmax", .kind = Kind::exchange, .value = T2, .coefficient = h2}},
                               .source = [](Index, double) { return DiffusionSource{.value = q}; }});
    CellField<double> T = uniform(mesh, 300.0);
    ASSERT_TRUE(diffusion.solve_steady(T).converged);
    errors.push_back(largest_error(mesh, T, exact));
    const double area = 0.01 * 0.02;
    EXPECT_NEAR(diffusion.outflow("xmin", T), h1 * (b - T1) * area, 1e-7 * q * L * area);
    EXPECT_NEAR(diffusion.outflow("xmin", T) + diffusion.outflow("xmax", T), q * L * area, 1e-7 * q * L * area);
  }
  EXPECT_NEAR(errors[0], q * std::pow(L / 10, 2) / (8.0 * k), 1e-6);  // of the two-point flux from cell to face
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.01);
}

TEST(Diffusion, FluxThroughALaminate) {
  const Mesh mesh = box(8, 1, 1, {0.08, 0.01, 0.01}, 1.0,
                        {{.name = "filler", .lower = {0.03, -1.0, -1.0}, .upper = {0.05, 1.0, 1.0}}});
  CellField<double> k = uniform(mesh, 0.2);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c][0] > 0.03 && mesh.cell_centre[c][0] < 0.05) k[c] = 5.0;
  Diffusion diffusion(mesh, {.conductivity = k,
                             .boundary = {{.patch = "xmin", .kind = Kind::value, .value = 20.0},
                                          {.patch = "xmax", .kind = Kind::flux, .value = 40.0}}});
  CellField<double> T = uniform(mesh, 0.0);
  ASSERT_TRUE(diffusion.solve_steady(T).converged);
  EXPECT_NEAR(diffusion.outflow("xmin", T), 40.0 * 1e-4, 1e-10);
  // The temperature rises by the flux times the resistances in series.
  const auto exact = [](const Vector& x) {
    const double within = std::clamp(x[0] - 0.03, 0.0, 0.02);
    return 20.0 + 40.0 * ((x[0] - within) / 0.2 + within / 5.0);
  };
  EXPECT_LT(largest_error(mesh, T, exact), 1e-6);
}

// On a uniform mesh sin(pi x) is an eigenvector of the discrete operator, so that each step of backward Euler divides
// it by 1 + dt lambda.
TEST(Diffusion, DecayOfTheFirstMode) {
  constexpr Index n = 16;
  constexpr double h = 1.0 / n, k = 2.0, c = 3.0, dt = 0.01, pi = std::numbers::pi;
  const Mesh mesh = box(n, 1, 1, {1.0, h, h});
  Diffusion diffusion(mesh,
                      {.conductivity = uniform(mesh, k),
                       .capacity = uniform(mesh, c),
                       .boundary = {{.patch = "xmin", .kind = Kind::value}, {.patch = "xmax", .kind = Kind::value}}});
  CellField<double> u = uniform(mesh, 0.0);
  for (Index i = 0; i < n; ++i) u[i] = std::sin(pi * mesh.cell_centre[i][0]);
  for (int step = 0; step < 5; ++step) ASSERT_TRUE(diffusion.step(dt, u).converged);
  const double lambda = k / c * std::pow(2.0 / h * std::sin(0.5 * pi * h), 2);
  const double factor = std::pow(1.0 + dt * lambda, -5);
  EXPECT_LT(largest_error(mesh, u, [&](const Vector& x) { return factor * std::sin(pi * x[0]); }), 1e-8);
}

// Heat that radiates: 0 = q - s u^4.
TEST(Diffusion, NonLinearSource) {
  const Mesh mesh = box(3, 3, 3);
  constexpr double q = 500.0, s = 5.67e-8;
  const auto source = [](Index, double u) {
    return DiffusionSource{.value = q - s * std::pow(u, 4), .slope = -4.0 * s * std::pow(u, 3)};
  };
  Diffusion diffusion(mesh, {.conductivity = uniform(mesh, 1.0), .boundary = {}, .source = source});
  CellField<double> u = uniform(mesh, 300.0);
  ASSERT_TRUE(diffusion.solve_steady(u).converged);
  for (const double value : u) EXPECT_NEAR(value, std::pow(q / s, 0.25), 1e-6);
}

// By the deferred correction; faces within 1e-3 of orthogonal go without.
TEST(Diffusion, LinearFieldOnTetrahedraAndPrisms) {
  const Mesh mesh = tetrahedra_and_prisms();
  Diffusion diffusion(mesh, {.conductivity = uniform(mesh, 1.4),
                             .boundary = {{.patch = "xmin", .kind = Kind::value, .value = -3.0},
                                          {.patch = "xmax", .kind = Kind::value, .value = 3.0}}});
  CellField<double> u = uniform(mesh, 0.0);
  ASSERT_TRUE(diffusion.solve_steady(u).converged);
  EXPECT_LT(largest_error(mesh, u, [](const Vector& x) { return x[0]; }), 3e-5);
  EXPECT_NEAR(diffusion.outflow("xmin", u), 1.4 * 36.0, 1e-4);
}

TEST(Diffusion, DoesNotDependOnThreads) {
  const Mesh mesh = tetrahedra_and_prisms();
  const auto solution = [&](int threads) {
    set_threads(threads);
    Diffusion diffusion(mesh,
                        {.conductivity = uniform(mesh, 1.4),
                         .boundary = {{.patch = "zmin", .kind = Kind::exchange, .value = 1.0, .coefficient = 0.3}},
                         .source = [](Index, double u) {
                           return DiffusionSource{1.0 - u * u * u, -3.0 * u * u};
                         }});
    CellField<double> u = uniform(mesh, 0.5);
    EXPECT_TRUE(diffusion.solve_steady(u).converged);
    set_threads(1);
    return u;
  };
  EXPECT_TRUE(solution(1) == solution(3));
}

TEST(Diffusion, SaysWhatIsWrong) {
  const Mesh mesh = box(2, 2, 2);
  const auto message = [&](std::vector<DiffusionBoundary> boundary, double k = 1.0) {
    return message_of<InputError>([&] {
      CellField<double> u = uniform(mesh, 0.0);
      Diffusion(mesh, {.conductivity = uniform(mesh, k), .boundary = std::move(boundary)}).solve_steady(u);
    });
  };
  EXPECT_THAT(message({{.patch = "top"}}), testing::HasSubstr("top"));
  EXPECT_THAT(message({{.patch = "xmin"}, {.patch = "xmin"}}), testing::HasSubstr("two boundary conditions"));
  EXPECT_THAT(message({{.patch = "xmin", .kind = Kind::exchange}}), testing::HasSubstr("has to be positive, found 0"));
  EXPECT_THAT(message({{.patch = "xmin"}}, -1.0), testing::HasSubstr("conductivity"));
  EXPECT_THAT(message({{.patch = "xmin", .kind = Kind::flux, .value = 1.0}}), testing::HasSubstr("arbitrary"));
}

}  // namespace
}  // namespace pfdm::this_file
