#include "solver/momentum/faces/face_tractions.h"

#include "solver/parallel.h"

namespace pfdm {

void SpareSweeps::GiveBack::operator()(Sweep* sweep) const {
  const std::lock_guard lock(to->mutex_);
  to->kept_.emplace_back(sweep);
}

std::unique_ptr<Sweep> SpareSweeps::pop() {
  const std::lock_guard lock(mutex_);
  if (kept_.empty()) return nullptr;
  std::unique_ptr<Sweep> last = std::move(kept_.back());
  kept_.pop_back();
  return last;
}

FaceField<Vector> FaceTractions::face_displacements(const std::vector<Vector>& u, const Sweep& sweep) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  FaceField<Vector> u_face(skeleton_.mesh.n_faces(), Vector::Zero());
  parallel_for(count_of(skeleton_.links),
               [&](Index i) { u_face[skeleton_.links[i].face] = link_displacement(i, u, sweep); });
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    const Index node = unknowns.n_cells + static_cast<Index>(k), face = unknowns.face_of_node[k];
    if (unknowns.node_of_face[face] == node) u_face[face] = u[node];
  }
  return u_face;
}

std::vector<double> FaceTractions::pressure_compliance() const {
  // Response of the displacements to a pressure, times lambda_s + 2 mu: between 1, of smooth pressures in the
  // continuum, and that with the damping of rough ones. Measured: 3 to 5 take the fewest iterations, 1 half as many
  // again.
  constexpr double answer = 4.0;
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  std::vector<double> compliance;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const PressureRow row = pressure_row(k);
    compliance.push_back(skeleton_.mesh.cell_volume[cells[k]] * (row.slope + answer / row.modulus));
  }
  return compliance;
}

}  // namespace pfdm
