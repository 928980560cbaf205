// A manufactured field of finite strain that changes no volume.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/equilibrium/finite_newton.h"
#include "tests/verification/finite_solutions.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

// Two simple shears, x = X + (a sin pi Y, b sin pi Z, 0), which change no volume: F = 1 + A e1 (x) e2 + B e2 (x) e3
// with A = a pi cos pi Y, B = b pi cos pi Z, and P = mu (F - F^-T) whatever Poisson's ratio is; Div P = mu (A', B', 0).
struct Sheared {
  double a = 0.3, b = 0.2, mu = 0.5e6;
  Vector displacement(const Vector& X) const {
    return {a * std::sin(std::numbers::pi * X.y()), b * std::sin(std::numbers::pi * X.z()), 0.0};
  }
  Vector body_force(const Vector& X) const {
    constexpr double square = std::numbers::pi * std::numbers::pi;
    return mu * square * displacement(X);
  }
  Tensor stress(const Vector& X) const {
    const double A = a * std::numbers::pi * std::cos(std::numbers::pi * X.y());
    const double B = b * std::numbers::pi * std::cos(std::numbers::pi * X.z());
    return mu * (Tensor() << 0.0, A, 0.0, A, 0.0, B, -A * B, B, 0.0).finished();
  }
};

struct ShearErrors {
  double u = 0.0, stress = 0.0;
  Index krylov_iterations = 0;
};

ShearErrors solve_sheared(const Mesh& mesh, double nu) {
  const Sheared exact;
  const IsotropicElasticity rubber{.lambda = 2.0 * exact.mu * nu / (1.0 - 2.0 * nu), .mu = exact.mu};
  const std::vector<std::shared_ptr<const Material>> materials(mesh.region_names.size(), neo_hookean(rubber));
  std::vector<BoundaryCondition> boundary;
  for (const Patch& patch : mesh.patches)
    boundary.push_back(moved(patch.name, {true, true, patch.name != "zmax"},
                             [&](const Vector& x, double t) -> Vector { return t * exact.displacement(x); }));
  const FractureModel model = finite_model(materials, boundary);
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const auto stiffness = make_cell_stiffness(mesh, model);
  MomentumSolver momentum(mesh, unknowns);
  FractureState state;
  state.displacement.assign(unknowns.n_unknowns(), Vector::Zero());
  state.damage = CellField<double>(mesh.n_cells(), 0.0);
  state.closure = CellField<double>(mesh.n_cells(), 0.0);
  ShearErrors errors;
  constexpr int steps = 4;
  for (int step = 1; step <= steps; ++step) {
    state.load = double(step) / steps;
    std::vector<Vector> force(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c)
      force[c] = state.load * mesh.cell_volume[c] * exact.body_force(mesh.cell_centre[c]);
    momentum.set_body_force(std::move(force));
    stiffness->set(state, momentum);
    const Equilibrium end =
        solve_finite(*stiffness, {.ceiling = 1e-7, .floor = 1e-7, .most_iterations = 3000}, momentum, state);
    EXPECT_TRUE(end.converged) << end.residual;
    errors.krylov_iterations += end.iterations;
  }
  const CellMechanics cells = momentum.balance().mechanics(state.displacement);
  const auto everywhere = [](Index) { return true; };
  errors.u = relative_error(
      mesh, [&](Index c) { return state.displacement[c]; },
      [&](Index c) { return exact.displacement(mesh.cell_centre[c]); }, everywhere);
  // The deviator: a small error of the volume times lambda is in the mean stress.
  double wrong = 0.0, whole = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Tensor P = exact.stress(mesh.cell_centre[c]), F = Tensor::Identity() + cells.gradient[c];
    wrong += mesh.cell_volume[c] * deviator(Tensor((cells.stress[c] - P) * F.transpose())).squaredNorm();
    whole += mesh.cell_volume[c] * deviator(Tensor(P * F.transpose())).squaredNorm();
  }
  errors.stress = std::sqrt(wrong / whole);
  return errors;
}

TEST(FiniteStrain, ManufacturedShearsConverge) {
  const auto box = [](double size) {
    ParticlesInBoxSettings settings;
    settings.upper = Vector::Ones(), settings.size_far = size, settings.particles = {};
    return make_particles_in_box(settings);
  };
  const Mesh coarse = box(0.22), fine = box(0.11);
  for (const bool polyhedra : {false, true})
    for (const double nu : {0.3, 0.49}) {
      const Mesh first = polyhedra ? barycentric_dual(coarse) : coarse;
      const Mesh second = polyhedra ? barycentric_dual(fine) : fine;
      const ShearErrors a = solve_sheared(first, nu), b = solve_sheared(second, nu);
      const double u_order = observed_order(a.u, first.n_cells(), b.u, second.n_cells());
      const double stress_order = observed_order(a.stress, first.n_cells(), b.stress, second.n_cells());
      report_row(fmt::format("{}, nu {}, {} and {} cells", polyhedra ? "polyhedra" : "tetrahedra", nu, first.n_cells(),
                             second.n_cells()),
                 {{"u", b.u},
                  {"order", u_order},
                  {"stress", b.stress},
                  {"order ", stress_order},
                  {"Krylov", double(a.krylov_iterations)},
                  {"Krylov ", double(b.krylov_iterations)}});
      EXPECT_GE(u_order, 1.5);
      EXPECT_GE(stress_order, 0.7);
    }
}

}  // namespace
}  // namespace pfdm::verification::this_file
