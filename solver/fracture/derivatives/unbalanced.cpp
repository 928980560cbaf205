#include "solver/fracture/derivatives/unbalanced.h"

#include "solver/parallel.h"

namespace pfdm {

Unbalanced unbalanced_of(Staggered& staggered, const FractureState& state,
                         const std::vector<InterfaceHistory>& before) {
  MomentumSolver& momentum = staggered.momentum();
  momentum.start_afresh();  // gradients weighted by the stiffness of now
  staggered.degrade(state);
  const std::vector<Vector>& u = state.displacement;
  if (staggered.faces().any()) staggered.faces().linearise(u, before, before, CohesiveFaces::Way::tangent, momentum);
  Unbalanced rest{.forces = momentum.unbalanced_forces(state.load, u),
                  .damage = CellField<double>(state.damage.size()),
                  .boundary_force = momentum.balance().boundary_forces(u),
                  .interfaces = before};
  staggered.faces().advance(momentum.balance(), u, before, rest.interfaces);
  const CellStiffness& stiffness = staggered.stiffness();
  const CellMechanics mechanics =
      momentum.balance().mechanics(u, MomentumOperator::Wanted::without_gradient, stiffness.degradable_part(state));
  DamageEquation& damage = staggered.damage_equation();
  damage.renewed_fracture_energy(state.damage);  // with the deferred flux of this damage
  parallel_for(state.damage.size(), [&](Index c) {
    rest.damage[c] = damage.is_damageable(c)
                         ? -damage.imbalance(c, state.damage, stiffness.driving_energy(c, mechanics, state))
                         : 0.0;
  });
  return rest;
}

}  // namespace pfdm
