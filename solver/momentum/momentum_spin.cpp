// Cells whose spin the unknowns do not see (spin_holds.h), in the momentum balance: forces by the energy
// 1/2 k (of_cell : G - target)^2 of each hold.

#include "solver/momentum/momentum.h"

namespace pfdm {

// Along the face of the cell that a displacement is prescribed on.
double MomentumOperator::prescribed_slope(const SpinHold& hold, double t) const {
  const auto value = [&](const Vector& x) -> Vector {
    for (const PatchCondition& on : unknowns_.conditions) {
      const Patch& patch = mesh_.patches[as_size(on.patch)];
      const bool is_here = hold.face >= patch.first_face && hold.face < patch.first_face + patch.n_faces;
      if (is_here && on.condition.value && on.condition.kind == BoundaryCondition::Kind::components)
        return on.condition.value(x, t);
    }
    return unknowns_.motion.displacement ? unknowns_.motion.displacement(x, t) : Vector::Zero();
  };
  const Vector& x = mesh_.face_centre[hold.face];
  const double reach = 0.25 * std::sqrt(mesh_.face_area[hold.face].norm());
  return hold.held.dot(value(x + reach * hold.along) - value(x - reach * hold.along)) / (2.0 * reach);
}

double MomentumOperator::shear_stiffness(Index cell) const {
  if (is_finite()) return finite_[cell].face.mu;
  return is_isotropic() ? moduli_[cell].mu : stiffness_[cell].trace() / 15.0;  // lambda = mu
}

// v += the forces of a hold whose spin is `much` too large.
void MomentumOperator::resist_spin(const SpinHold& hold, double much, std::vector<Vector>& v) const {
  double mu = shear_stiffness(hold.cell);
  if (hold.beyond >= 0) mu = std::min(mu, shear_stiffness(hold.beyond));
  const Tensor moment = (mu * hold.stiffness * much) * hold.of_cell;
  gradient_.spread(hold.cell, moment, v);
  if (hold.beyond >= 0) gradient_.spread(hold.beyond, -moment, v);
}

void MomentumOperator::hold_spins(std::vector<Vector>& out) const {
  if (unknowns_.spin_holds.empty()) return;
  std::vector<Vector> forces(as_size(unknowns_.n_unknowns()), Vector::Zero());
  for (const SpinHold& hold : unknowns_.spin_holds) {
    const double beyond = hold.beyond >= 0 ? contract(hold.of_cell, gradients_[hold.beyond]) : 0.0;
    resist_spin(hold, contract(hold.of_cell, gradients_[hold.cell]) - beyond, forces);
  }
  add_free_part(forces, out);
}

void MomentumOperator::add_spin_targets(double t, std::vector<Vector>& load) const {
  if (unknowns_.spin_holds.empty()) return;
  std::vector<Vector> forces(load.size(), Vector::Zero());
  for (const SpinHold& hold : unknowns_.spin_holds)
    if (hold.beyond < 0) resist_spin(hold, prescribed_slope(hold, t), forces);
  add_free_part(forces, load);
}

void MomentumOperator::add_free_part(std::vector<Vector>& forces, std::vector<Vector>& out) const {
  keep_in_plane(forces);
  for (Index i = 0; i < unknowns_.n_nodes(); ++i)
    out[as_size(i)] += i < unknowns_.n_cells
                           ? forces[as_size(i)]
                           : (unknowns_.free_directions[as_size(i - unknowns_.n_cells)] * forces[as_size(i)]).eval();
}

}  // namespace pfdm
