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

}  // namespace pfdm
