#include "solver/momentum/bending/body_ends.h"

#include <cmath>

namespace pfdm {

FaceField<BodyEnd> body_ends(const Mesh& mesh, const Unknowns& unknowns) {
  FaceField<BodyEnd> end(mesh.n_faces(), BodyEnd::free);
  for (const PatchCondition& on : unknowns.conditions) {
    using Kind = BoundaryCondition::Kind;
    const auto& held = on.condition.displacement_prescribed;
    const auto is_held_along = [&](std::size_t i) {  // or nothing moves there: across a plane mesh
      return held[i] || std::abs(unknowns.plane_normal[i]) > 0.999;
    };
    const bool is_held =
        on.condition.kind == Kind::components && is_held_along(0) && is_held_along(1) && is_held_along(2);
    if (on.condition.kind != Kind::symmetry && !is_held) continue;
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      end[f] = is_held ? BodyEnd::held : BodyEnd::mirror;
  }
  return end;
}

FaceField<char> resting_rollers(const Mesh& mesh, const Unknowns& unknowns) {
  FaceField<char> rests(mesh.n_faces(), 0);
  for (const PatchCondition& on : unknowns.conditions) {
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = unknowns.node_of_face[f];
      const Vector normal = mesh.face_area[f].normalized();
      if (node < 0 || !unknowns.glides(node, normal)) continue;
      const Vector move = on.condition.value ? on.condition.value(mesh.face_centre[f], 1.0) : Vector::Zero();
      rests[f] = normal.dot(move) == 0.0 ? 1 : 0;
    }
  }
  return rests;
}

}  // namespace pfdm
