#include "solver/fracture/equilibrium/load_work.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

double potential_of_loads(const MomentumOperator& balance, const FractureState& state) {
  const std::vector<Vector> load = balance.applied_forces(state.load);
  double potential = balance.foundation_energy(state.displacement);
  for (std::size_t i = 0; i < load.size(); ++i) potential -= load[i].dot(state.displacement[i]);
  return potential;
}

double work_of_loads(const Mesh& mesh, const Unknowns& unknowns, const FractureState& from, const LoadedBody& to) {
  double work = 0.0;
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) {
    const Index node = unknowns.node_of_face[f];
    if (node < 0) continue;
    const std::size_t k = f - mesh.n_interior_faces();
    work += 0.5 * (from.boundary_force[k] + to.force[k]).dot(to.displacement[node] - from.displacement[node]);
  }
  if (const auto& body = unknowns.loads.force)
    work += parallel_sum(mesh.n_cells(), [&](Index c) {
      const Vector before = from.step > 0 ? body(mesh, c, from.load) : Vector::Zero();
      const Vector moved = to.displacement[c] - from.displacement[c];
      return 0.5 * mesh.cell_volume[c] * (before + body(mesh, c, to.load)).dot(moved);
    });
  return work;
}

double work_of_free_loads(const MomentumOperator& balance, const Unknowns& unknowns, const FractureState& state) {
  const std::vector<Vector> force = balance.traction_forces(state.load);
  constexpr double falls = 3.0;  // so much farther moves what falls than what prescribed displacements move
  double prescribed = 0.0;
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    const Vector& u = state.displacement[unknowns.n_cells + k];
    prescribed = std::max(prescribed, (u - unknowns.free_directions[k] * u).norm());
  }
  double work = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const bool is_body_force = i < as_size(unknowns.n_cells);
    if (is_body_force && state.displacement[i].norm() <= falls * prescribed) continue;
    work += force[i].dot(state.displacement[i]);
  }
  return work;
}

double eigenstrain_work(const FreeStrained& from, const FreeStrained& to) {
  return parallel_sum(to.eigenstrain.size(), [&](Index c) {
    if (from.eigenstrain.size() == 0) return -0.5 * to.moment[c].dot(to.eigenstrain[c]);
    const Mandel grown = to.eigenstrain[c] - from.eigenstrain[c];
    return -0.5 * (from.moment[c] + to.moment[c]).dot(grown);
  });
}

}  // namespace pfdm
