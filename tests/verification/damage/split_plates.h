#pragma once
// Plates with an energy split in equilibrium at given damage.

#include "solver/fracture/equilibrium/law_newton.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification {

inline const IsotropicElasticity steel = from_young_poisson(210e9, 0.3);
inline constexpr double residual_stiffness = 1e-6;

inline Mesh plate(Index n, double thickness = 1.0) {
  return make_box_hexes(
      {.axes = {{{{1.0, n, 1.0}}, {{1.0, n, 1.0}}, {{thickness, 1, 1.0}}}}, .regions = {}, .slits = {}});
}

inline FractureModel damaged_model(const EnergySplit& split, std::vector<BoundaryCondition> boundary) {
  FractureModel model = elastic_model({steel}, std::move(boundary));
  model.regions[0] = {.elasticity = steel, .Gc = 1.0, .ell = 1.0};
  model.split = split;
  model.residual_stiffness = residual_stiffness;
  return model;
}

struct Equilibrated {
  FractureState state;
  CellMechanics cells;
  std::vector<Vector> reaction;  // per patch [N]
  Index iterations = 0, krylov = 0;
  double energy = 0.0;  // [J]
};

/// Equilibrium at given damage: closures follow the strain until they falsify the energy by less than 1e-13. The
/// iterations count Newton's steps, too.
inline Equilibrated equilibrium(const Mesh& mesh, const FractureModel& model, CellField<double> damage) {
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumSolver solver(mesh, unknowns);
  const auto stiffness = make_cell_stiffness(mesh, model);
  stiffness->start_step(0.0);
  Equilibrated result;
  const std::size_t n = mesh.n_cells();
  result.state.damage = std::move(damage);
  result.state.closure = CellField<double>(n, 0.0);
  result.state.displacement.assign(unknowns.n_unknowns(), Vector::Zero());
  result.state.load = 1.0;
  constexpr MomentumSolver::Tolerance tight{.ceiling = 1e-12, .floor = 1e-12};
  for (double unsettled = 1.0; unsettled > 1e-13 && result.iterations < 50;) {
    stiffness->set(result.state, solver);
    const Equilibrium on = stiffness->is_linearised() ? solve_with_laws(*stiffness, tight, solver, result.state)
                                                      : solver.solve(1.0, tight, result.state.displacement);
    EXPECT_TRUE(on.converged) << on.residual;
    result.iterations += std::max<Index>(1, on.newton_steps);
    result.krylov += on.iterations;
    result.cells = solver.balance().mechanics(result.state.displacement, MomentumOperator::Wanted::all,
                                              stiffness->degradable_part(result.state));
    result.energy = 0.0;
    for (const double energy : result.cells.energy) result.energy += energy;
    unsettled = stiffness->follow(result.cells, result.state) / result.energy;
  }
  EXPECT_LT(result.iterations, 50);
  result.reaction.assign(mesh.patches.size(), Vector::Zero());
  const std::vector<Vector> force = solver.balance().boundary_forces(result.state.displacement);
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (Index f = 0; f < mesh.patches[p].n_faces; ++f)
      result.reaction[p] += force[mesh.patches[p].first_face + f - mesh.n_interior_faces()];
  return result;
}

inline const Vector& reaction(const Mesh& mesh, const Equilibrated& on, const std::string& patch) {
  return on.reaction[mesh.patch_index(patch)];
}

}  // namespace pfdm::verification
