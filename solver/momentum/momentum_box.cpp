// Boxes whose sides follow a mean strain: periodic faces and free strains in the momentum balance (momentum.h).

#include "solver/momentum/momentum.h"

namespace pfdm {

void MomentumOperator::gather_from_images(std::vector<Vector>& forces) const {
  for (const PeriodicNodes& pair : unknowns_.periodic) {
    forces[as_size(pair.node)] += forces[as_size(pair.image)];
    forces[as_size(pair.image)].setZero();
  }
}

// From the forces on the faces, which `out` has not where they are held.
void MomentumOperator::work_on_free_strains(std::vector<Vector>& out) const {
  const BoxMotion& motion = unknowns_.motion;
  if (!unknowns_.has_free_strains()) return;
  const auto force_on = [&](Index node) {
    return forces_[links_.size() + as_size(first_side_of_node_[as_size(node - unknowns_.n_cells)])];
  };
  Tensor moment = Tensor::Zero();
  for (const HeldFace& held : motion.held) {
    const Index node = unknowns_.node_of_face[held.face];
    Vector force = force_on(node);
    for (const PeriodicNodes& pair : unknowns_.periodic)
      if (pair.node == node) force += force_on(pair.image);  // which moves with it
    moment += held.directions * force * (mesh_.face_centre[held.face] - motion.centre).transpose();
  }
  for (const PeriodicNodes& pair : unknowns_.periodic)
    moment += force_on(pair.image) * (place(pair.image) - place(pair.node)).transpose();
  for (std::size_t k = 0; k < motion.free_strains.size(); ++k)
    out[as_size(unknowns_.first_strain()) + k] = contract(motion.free_strains[k].direction, moment) * Vector::UnitX();
}

void MomentumOperator::move_images(std::vector<Vector>& v) const {
  for (const PeriodicNodes& pair : unknowns_.periodic) v[as_size(pair.image)] = v[as_size(pair.node)];
}

}  // namespace pfdm
