#include "solver/fracture/model/symmetry_planes.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Whether the mirror image of the body would continue it: no tangential traction, no normal displacement.
bool is_symmetry_plane(const Mesh& mesh, const BoundaryCondition& condition, Index face) {
  using Kind = BoundaryCondition::Kind;
  if (condition.kind == Kind::symmetry) return true;
  if (condition.kind != Kind::components || condition.value || condition.pressure) return false;
  constexpr double parallel = 1.0 - 1e-8;
  const Vector n = mesh.face_area[face].normalized();
  for (std::size_t i = 0; i < 3; ++i)
    if (condition.displacement_prescribed[i] != (std::abs(n[i]) > parallel)) return false;
  return true;
}

// Whether the cell is of a row beside the plane, and another one follows.
bool has_opposite_face(const Mesh& mesh, Index cell, const Vector& normal) {
  constexpr double parallel = 0.98;
  return std::ranges::any_of(mesh.faces_of_cell(cell), [&](Index f) {
    return mesh.is_interior(f) && std::abs(mesh.face_area[f].normalized().dot(normal)) > parallel;
  });
}

}  // namespace

CellField<Vector> damage_points(const Mesh& mesh, const FractureModel& model) {
  CellField<Vector> shift;
  for (const BoundaryCondition& condition : model.boundary) {
    const Patch& patch = mesh.patch(condition.patch);
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index c = mesh.owner[f];
      if (!model.in_cell(mesh, c).damageable || !is_symmetry_plane(mesh, condition, f)) continue;
      const Vector n = mesh.face_area[f].normalized();
      if (!has_opposite_face(mesh, c, n)) continue;
      if (shift.size() == 0) shift = CellField<Vector>(mesh.n_cells(), Vector::Zero());
      const double to_plane = (mesh.face_centre[f] - mesh.cell_centre[c]).dot(n);
      if (to_plane > 0.5 * model.in_cell(mesh, c).ell) continue;
      if (shift[c].dot(n) < 0.5 * to_plane) shift[c] += to_plane * n;  // once, if several faces lie in the plane
    }
  }
  return shift;
}

}  // namespace pfdm
