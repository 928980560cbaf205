#include "solver/momentum/spin_forces.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Slope along the face of the cell that a displacement is prescribed on.
double prescribed_slope(const Mesh& mesh, const BoundaryLoads& loads, const SpinHold& hold, double t) {
  const Vector& x = mesh.face_centre[hold.face];
  const double reach = 0.25 * std::sqrt(mesh.face_area[hold.face].norm());
  return hold.held.dot(loads.prescribed_at(hold.face, x + reach * hold.along, t) -
                       loads.prescribed_at(hold.face, x - reach * hold.along, t)) /
         (2.0 * reach);
}

}  // namespace

// v += the forces of a hold whose spin is `much` too large.
void SpinForces::resist(const SpinHold& hold, const FaceTractions& tractions, double much,
                        std::vector<Vector>& v) const {
  double mu = tractions.shear_stiffness(hold.cell);
  if (hold.beyond >= 0) mu = std::min(mu, tractions.shear_stiffness(hold.beyond));
  const Tensor moment = (mu * hold.stiffness * much) * hold.of_cell;
  gradient_.spread(hold.cell, moment, v);
  if (hold.beyond >= 0) gradient_.spread(hold.beyond, -moment, v);
}

void SpinForces::add(const FaceTractions& tractions, const CellField<Tensor>& gradients,
                     std::vector<Vector>& out) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  if (unknowns.spin_holds.empty()) return;
  std::vector<Vector> forces(unknowns.n_unknowns(), Vector::Zero());
  for (const SpinHold& hold : unknowns.spin_holds) {
    const double beyond = hold.beyond >= 0 ? contract(hold.of_cell, gradients[hold.beyond]) : 0.0;
    resist(hold, tractions, contract(hold.of_cell, gradients[hold.cell]) - beyond, forces);
  }
  add_free_part(forces, out);
}

void SpinForces::add_targets(const FaceTractions& tractions, const BoundaryLoads& loads, double t,
                             std::vector<Vector>& load) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  if (unknowns.spin_holds.empty()) return;
  std::vector<Vector> forces(load.size(), Vector::Zero());
  for (const SpinHold& hold : unknowns.spin_holds)
    if (hold.beyond < 0) resist(hold, tractions, prescribed_slope(skeleton_.mesh, loads, hold, t), forces);
  add_free_part(forces, load);
}

void SpinForces::add_free_part(std::vector<Vector>& forces, std::vector<Vector>& out) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  skeleton_.keep_in_plane(forces);
  for (Index i = 0; i < unknowns.n_nodes(); ++i)
    out[i] += i < unknowns.n_cells ? forces[i] : (unknowns.free_directions[skeleton_.number_of(i)] * forces[i]).eval();
}

}  // namespace pfdm
