#include "solver/fracture/cells/cell_stiffness.h"

#include "solver/fracture/cells/finite_stiffness.h"
#include "solver/fracture/cells/small_stiffness.h"
#include "solver/parallel.h"

namespace pfdm {

void CellStiffness::start_step(double, const CellField<double>&) { closures_.start_step(mesh_.n_cells()); }

double CellStiffness::factor(Index cell, double d) const {
  const RegionModel& region = model_.in_cell(mesh_, cell);
  if (!region.damageable) return 1.0;
  return (1.0 - model_.residual_stiffness) * model_.degradation_of(region).g(d) + model_.residual_stiffness;
}

void CellStiffness::set(const FractureState& state, MomentumSolver& momentum) const {
  CellField<double> g(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) { g[c] = factor(c, seen(c, state)); });
  momentum.set_eigenstrain(state.step > 0 ? std::optional(state.load) : std::nullopt, state.heat.felt);
  give(state, g, momentum);
}

CellField<IsotropicElasticity> CellStiffness::degradable_part(const FractureState&) const {
  return CellField<IsotropicElasticity>(mesh_.n_cells(), {});
}

bool CellStiffness::descends() const {
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (is_damageable(c) && !descends(c)) return false;
  return model_.irreversibility != Irreversibility::history && !model_.has_strength();
}

double CellStiffness::residual_energy(Index cell, double psi_plus, double idle, const FractureState& state) const {
  const RegionModel& region = model_.in_cell(mesh_, cell);
  if (!region.damageable) return 0.0;
  const double lost = 1.0 - model_.degradation_of(region).g(seen(cell, state));
  return model_.residual_stiffness * lost * (psi_plus + idle) * mesh_.cell_volume[cell];
}

double CellStiffness::plastic_dissipation(const FractureState& from, const FractureState& to) const {
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return plastic_dissipation(c, from, to); });
}

std::unique_ptr<CellStiffness> make_cell_stiffness(const Mesh& mesh, const FractureModel& model) {
  if (model.is_finite_strain()) return std::make_unique<FiniteStiffness>(mesh, model);
  return std::make_unique<SmallStiffness>(mesh, model);
}

}  // namespace pfdm
