#include "solver/fracture/cells/finite_stiffness.h"

#include "solver/parallel.h"

namespace pfdm {

void FiniteStiffness::give(const FractureState& state, const CellField<double>& g, MomentumSolver& momentum) const {
  const CellField<Mandel>& free = momentum.balance().eigenstrain();
  const auto law = [&](Index c, Index own, const Tensor& H) {
    return cells_->law({c, own}, H, {g[c], state.closure[c]},
                       free.size() > 0 ? FreeDeformation(to_tensor(free[c])) : FreeDeformation());
  };
  momentum.set_finite(law, cells_->histories().gaps(), g, state.displacement, state.load);
}

double FiniteStiffness::integrate(const CellMechanics& mechanics, const FractureState&, FractureState& state) {
  if (!has_histories()) return 0.0;
  CellField<Degraded> left(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) { left[c] = this->left(c, state); });
  cells_->advance(mechanics, left, state.histories);
  return 0.0;
}

CellEnergies FiniteStiffness::energies(const CellMechanics& mechanics, const FractureState& state) const {
  const std::size_t n = mesh_.n_cells();
  CellField<FiniteEnergies> of_cells(n);
  CellEnergies energies{
      .driving = CellField<double>(n), .stored = CellField<double>(n), .idle = CellField<double>(n, 0.0)};
  parallel_for(mesh_.n_cells(), [&](Index c) {
    of_cells[c] = energies_of(c, mechanics, state);
    energies.driving[c] = driving_at(c, of_cells[c], state.damage[c]).value;
    energies.stored[c] = cells_->stored_energy(c, of_cells[c], factor(c, state.damage[c]));
  });
  energies.law = [this, at = std::make_shared<const CellField<FiniteEnergies>>(std::move(of_cells))](
                     Index c, double d) { return driving_at(c, (*at)[c], d); };
  return energies;
}

DrivingAt FiniteStiffness::driving_at(Index cell, const FiniteEnergies& at, double d) const {
  const double g_prime = model_.degradation_of(model_.in_cell(mesh_, cell)).g_prime(d);
  const DrivingAt by_g = cells_->driving_energy(cell, at, factor(cell, d));
  return {.value = by_g.value, .slope = (1.0 - model_.residual_stiffness) * g_prime * by_g.slope};
}

double FiniteStiffness::driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  return driving_at(cell, energies_of(cell, mechanics, state), state.damage[cell]).value;
}

double FiniteStiffness::stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  return cells_->stored_energy(cell, energies_of(cell, mechanics, state), factor(cell, state.damage[cell]));
}

bool FiniteStiffness::depends_on_strain() const {
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (is_damageable(c)) return true;
  return false;
}

CellField<Mandel> FiniteStiffness::eigenstrain_moments(const CellMechanics& mechanics, const FractureState& state,
                                                       const Vector& plane_normal) const {
  CellField<Mandel> moments(mechanics.eigenstrain.size());
  parallel_for(moments.size(), [&](Index c) {
    moments[c] = to_mandel(cells_->eigenstrain_moment(c, mechanics, left(c, state), plane_normal));
  });
  return moments;
}

double FiniteStiffness::plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const {
  return cells_->dissipation(cell, from.histories, factor(cell, from.damage[cell]), to.histories,
                             factor(cell, to.damage[cell]));
}

Tensor FiniteStiffness::undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  return cells_->undamaged_biot_stress(cell, mechanics, left(cell, state));
}

void FiniteStiffness::show(const CellMechanics& mechanics, const FractureState& state, const Vector& plane_normal,
                           OutputFields& fields) const {
  fields.deformation_gradient = CellField<Tensor>(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const Degraded left = this->left(c, state);
    const Tensor F = Tensor::Identity() + cells_->thinned(c, mechanics, left);
    fields.deformation_gradient[c] = F;
    fields.strain[c] = 0.5 * (F.transpose() * F - Tensor::Identity());
    fields.stress[c] = cells_->cauchy_stress(c, mechanics, left, plane_normal);
  });
}

double FiniteStiffness::follow(const CellMechanics& mechanics, FractureState& state) {
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return follow_volume(c, mechanics, state); });
}

double FiniteStiffness::follow_volume(Index cell, const CellMechanics& mechanics, FractureState& state) {
  const Degraded left{factor(cell, seen(cell, state)), state.closure[cell]};
  const std::optional<double> change = cells_->closing_change(cell, mechanics, left);
  if (!change) return 0.0;
  state.closure[cell] = closures_.next(cell, left.g, left.closure, *change < 0.0 ? 1.0 : 0.0);
  return cells_->closing_energy(cell, *change, left);
}

}  // namespace pfdm
