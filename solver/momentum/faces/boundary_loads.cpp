#include "solver/momentum/faces/boundary_loads.h"

#include "solver/momentum/body/face_mean.h"
#include "solver/parallel.h"

namespace pfdm {
BoundaryLoads::BoundaryLoads(const FaceSkeleton& skeleton)
    : skeleton_(skeleton), pressed_faces_(skeleton.mesh, skeleton.unknowns) {
  const Mesh& mesh = skeleton.mesh;
  for (const PatchCondition& on : skeleton.unknowns.conditions) {
    if (on.condition.kind != BoundaryCondition::Kind::elastic_foundation) continue;
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Tensor K = on.condition.foundation(mesh.face_centre[f]).tensor(mesh.face_area[f].normalized());
      supports_.push_back({skeleton.unknowns.node_of_face[f], mesh.face_area[f].norm() * K});
    }
  }
}

void BoundaryLoads::add_response(const std::vector<Vector>& u, const CellField<Tensor>& gradients,
                                 std::vector<Vector>& out) const {
  for (const Support& at : supports_) out[at.node] += at.stiffness * u[at.node];
  pressed_faces_.add_turn(u, gradients, out);
}

void BoundaryLoads::add_to(BlockTriplets& matrix) const {
  for (const Support& at : supports_) matrix.diagonal[at.node] += at.stiffness;
}

double BoundaryLoads::stored(const std::vector<Vector>& u) const {
  double energy = 0.0;
  for (const Support& at : supports_) energy += 0.5 * u[at.node].dot(at.stiffness * u[at.node]);
  return energy;
}

void BoundaryLoads::add_tractions(double t, std::vector<Vector>& load) const {
  const Mesh& mesh = skeleton_.mesh;
  const Unknowns& unknowns = skeleton_.unknowns;
  for (const PatchCondition& on : unknowns.conditions) {
    const BoundaryCondition& condition = on.condition;
    if (condition.kind != BoundaryCondition::Kind::components || !condition.value) continue;
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = unknowns.node_of_face[f];
      const Tensor& is_free = unknowns.free_directions[skeleton_.number_of(node)];
      if (is_free.isZero()) continue;
      const Vector traction = mean_over_face(mesh, f, [&](const Vector& x) { return condition.value(x, t); });
      load[node] = is_free * traction * mesh.face_area[f].norm();
    }
  }
}

std::vector<Vector> BoundaryLoads::forces(double t) const {
  const Mesh& mesh = skeleton_.mesh;
  const Unknowns& unknowns = skeleton_.unknowns;
  std::vector<Vector> load(unknowns.n_unknowns(), Vector::Zero());
  add_tractions(t, load);
  pressed_faces_.add_forces(t, load);
  if (const auto& force = unknowns.loads.force)
    parallel_for(mesh.n_cells(), [&](Index c) { load[c] += mesh.cell_volume[c] * force(mesh, c, t); });
  const BoxMotion& motion = unknowns.motion;
  for (std::size_t k = 0; k < motion.free_strains.size(); ++k)
    if (motion.free_strains[k].stress)
      load[unknowns.first_strain() + k] = motion.size.prod() * motion.free_strains[k].stress(t) * Vector::UnitX();
  skeleton_.keep_in_plane(load);
  return load;
}

void BoundaryLoads::prescribe(double t, std::vector<Vector>& u) const {
  const Mesh& mesh = skeleton_.mesh;
  const Unknowns& unknowns = skeleton_.unknowns;
  for (const PatchCondition& on : unknowns.conditions) {
    const BoundaryCondition& condition = on.condition;
    if (is_front_or_back(condition)) continue;
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = unknowns.node_of_face[f];
      const Tensor& is_free = unknowns.free_directions[skeleton_.number_of(node)];
      const Vector value = condition.value ? condition.value(mesh.face_centre[f], t) : Vector::Zero();
      u[node] = is_free * u[node] + (Tensor::Identity() - is_free) * value;
    }
  }
  move_box(t, u);
  skeleton_.keep_in_plane(u);
}

void BoundaryLoads::move_box(double t, std::vector<Vector>& u) const {
  const Mesh& mesh = skeleton_.mesh;
  const Unknowns& unknowns = skeleton_.unknowns;
  const BoxMotion& motion = unknowns.motion;
  const Tensor E = unknowns.free_strain(u);
  const auto of_body = [&](const Vector& x) -> Vector {
    const Vector free = E * (x - motion.centre);
    return motion.displacement ? (free + motion.displacement(x, t)).eval() : free;
  };
  for (const HeldFace& held : motion.held) {
    Vector& here = u[unknowns.node_of_face[held.face]];
    here += held.directions * (of_body(mesh.face_centre[held.face]) - here);
  }
  for (const PeriodicNodes& pair : unknowns.periodic)
    u[pair.image] = u[pair.node] + of_body(unknowns.place(mesh, pair.image)) - of_body(unknowns.place(mesh, pair.node));
}

Vector BoundaryLoads::prescribed_at(Index face, const Vector& x, double t) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  for (const PatchCondition& on : unknowns.conditions) {
    const Patch& patch = skeleton_.mesh.patches[on.patch];
    const bool is_here = face >= patch.first_face && face < patch.first_face + patch.n_faces;
    if (is_here && on.condition.value && on.condition.kind == BoundaryCondition::Kind::components)
      return on.condition.value(x, t);
  }
  return unknowns.motion.displacement ? unknowns.motion.displacement(x, t) : Vector::Zero();
}

}  // namespace pfdm
