#pragma once
// Bodies with eigenstrains, and their equilibrium at given damage.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/equilibrium/law_newton.h"
#include "tests/verification/bar.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace pfdm::verification {

inline const IsotropicElasticity glass = from_young_poisson(70e9, 0.2), epoxy = from_young_poisson(3e9, 0.35),
                                 rubber = from_young_poisson(3e6, 0.4999);

inline std::shared_ptr<const LoadField<Tensor>> given(const Tensor& strain) {
  return std::make_shared<const LoadField<Tensor>>([strain](const Vector&, double t) -> Tensor { return t * strain; });
}

struct Answer {
  CellMechanics cells;
  CellField<double> driving, stored;
  double residual = 0.0;
};

/// Equilibrium at given damage and the load parameter 1: closures follow until they falsify the energy by less than
/// 1e-13.
inline Answer equilibrium(const Mesh& mesh, const FractureModel& model, const CellField<double>& damage) {
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumSolver solver(mesh, unknowns);
  const auto stiffness = make_cell_stiffness(mesh, model);
  stiffness->start_step(0.0);
  const std::size_t n = mesh.n_cells();
  FractureState state;
  state.step = 1;
  state.load = 1.0;
  state.damage = damage;
  state.closure = CellField<double>(n, 0.0);
  state.displacement.assign(unknowns.n_unknowns(), Vector::Zero());
  constexpr MomentumSolver::Tolerance tight{.ceiling = 1e-12, .floor = 1e-12};
  Answer answer;
  answer.driving = answer.stored = CellField<double>(n);
  double unsettled = 1.0;
  for (int k = 0; unsettled > 1e-13 && k < 60; ++k) {
    stiffness->set(state, solver);
    const Equilibrium on = stiffness->is_linearised() ? solve_with_laws(*stiffness, tight, solver, state)
                                                      : solver.solve(1.0, tight, state.displacement);
    EXPECT_LT(on.residual, 1e-11);
    answer.residual = on.residual;
    answer.cells = solver.balance().mechanics(state.displacement, MomentumOperator::Wanted::all,
                                              stiffness->degradable_part(state));
    double energy = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) energy += stiffness->stored_energy(c, answer.cells, state);
    unsettled = stiffness->follow(answer.cells, state) / std::max(energy, 1e-300);
  }
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    answer.driving[c] = stiffness->driving_energy(c, answer.cells, state);
    answer.stored[c] = stiffness->stored_energy(c, answer.cells, state);
  }
  return answer;
}

/// Damage of cells from sound to nearly broken, in patches.
inline CellField<double> some_damage(const Mesh& mesh) {
  CellField<double> damage(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    damage[c] = 0.45 * (1.0 + std::sin(3.0 * x[0] + 1.0) * std::cos(2.0 * x[1] - 0.3 * x[2]));
  }
  return damage;
}

inline double largest(const CellField<Tensor>& field) {
  double most = 0.0;
  for (const Tensor& value : field) most = std::max(most, value.norm());
  return most;
}

}  // namespace pfdm::verification
