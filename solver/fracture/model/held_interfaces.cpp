#include "solver/fracture/model/held_interfaces.h"

#include "mesh/disjoint_sets.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

namespace pfdm {
namespace {

/// Periodic sides hold one face only, against rigid motions.
bool has_held_sides(const FractureModel& model) {
  return !model.interfaces.empty() && model.motion.any() && model.motion.periodic.empty();
}

/// The side of the box that a face is on, 0 to 5.
unsigned side_of_box(const Mesh& mesh, Index face) {
  Index axis = 0;
  const Vector& S = mesh.face_area[face];
  S.cwiseAbs().maxCoeff(&axis);
  return static_cast<unsigned>(2 * axis + (S[axis] > 0.0 ? 1 : 0));
}

/// Points of the held faces, by side.
std::array<std::set<Index>, 6> held_points(const Mesh& mesh, const FractureModel& model) {
  std::array<std::set<Index>, 6> points;
  for (const HeldFace& held : model.motion.held)
    for (const Index p : mesh.points_of_face(held.face)) points[side_of_box(mesh, held.face)].insert(p);
  return points;
}

/// The first face of a surface with an edge on a held side.
std::optional<Index> face_at_side(const Mesh& mesh, const CohesiveSurface& surface,
                                  const std::array<std::set<Index>, 6>& held) {
  for (const Index f : surface.faces)
    for (const std::set<Index>& points : held)
      if (std::ranges::count_if(mesh.points_of_face(f), [&](Index p) { return points.contains(p); }) >= 2) return f;
  return std::nullopt;
}

/// Whether some part of the box, along whose faces nothing separates, is held on all sides that are held at all.
bool is_whole(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns) {
  DisjointSets parts(mesh.n_cells());
  std::vector<bool> separates(mesh.n_interior_faces(), false);
  for (const Index f : unknowns.split_faces) separates[f] = true;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f)
    if (!separates[f]) parts.join(mesh.owner[f], as_size(mesh.neighbour[f]));
  std::map<std::size_t, std::set<unsigned>> sides;  // of each part
  std::set<unsigned> all;
  for (const HeldFace& held : model.motion.held) {
    const unsigned side = side_of_box(mesh, held.face);
    sides[parts.least_with(mesh.owner[held.face])].insert(side);
    all.insert(side);
  }
  return std::ranges::any_of(sides, [&](const auto& part) { return part.second == all; });
}

}  // namespace

void require_whole_box(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns) {
  if (!has_held_sides(model) || is_whole(mesh, model, unknowns)) return;
  const auto held = held_points(mesh, model);
  for (const CohesiveSurface& surface : model.interfaces)
    if (const auto face = face_at_side(mesh, surface, held))
      throw InputError(fmt::format(
          "interface \"{}\" parts the box and ends at its sides, as at ({:.4g}, {:.4g}, {:.4g}) m; with "
          "the boundary condition \"uniform displacement\" the sides are in one piece and would hold it "
          "together: take \"periodic\" (homogenization.boundary)",
          surface.name, mesh.face_centre[*face][0], mesh.face_centre[*face][1], mesh.face_centre[*face][2]));
}

std::vector<std::string> held_interface_warnings(const Mesh& mesh, const FractureModel& model) {
  std::vector<std::string> lines;
  if (!has_held_sides(model)) return lines;
  const auto held = held_points(mesh, model);
  for (const CohesiveSurface& surface : model.interfaces)
    if (const auto face = face_at_side(mesh, surface, held))
      lines.push_back(fmt::format(
          "interface \"{}\" ends at a side of the box, as at ({:.4g}, {:.4g}, {:.4g}) m: with the boundary condition "
          "\"uniform displacement\" the sides are in one piece and hold it together there; with \"periodic\" "
          "(homogenization.boundary) it opens",
          surface.name, mesh.face_centre[*face][0], mesh.face_centre[*face][1], mesh.face_centre[*face][2]));
  return lines;
}

}  // namespace pfdm
