#include "solver/momentum/body/unknowns.h"

#include "physics/error.h"
#include "solver/momentum/body/rigid_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace pfdm {
namespace {

// Poisson's ratio above which cells have a pressure. Measured: from 0.46 on it makes the errors smaller, from 0.475 to
// 0.49 on it takes no longer than doing without.
constexpr double nearly_incompressible = 0.47;

CellField<Index> elastic_zones(const Mesh& mesh, const ElasticBody& body) {
  CellField<Index> zone(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) zone[c] = body.zone[mesh.region[c]];
  return zone;
}

std::vector<PatchCondition> conditions_by_patch(const Mesh& mesh, const ElasticBody& body) {
  std::vector<PatchCondition> conditions;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    conditions.push_back({static_cast<Index>(p), {.patch = mesh.patches[p].name, .value = {}}});
  std::vector<bool> said(mesh.patches.size(), false);
  for (const BoundaryCondition& condition : body.boundary) {
    const Index p = mesh.patch_index(condition.patch);
    if (said[p]) throw InputError(fmt::format("patch \"{}\" has two boundary conditions", condition.patch));
    said[p] = true;
    conditions[p].condition = condition;
  }
  return conditions;
}

// Mean unit normal of a patch that has to be plane.
Vector plane_patch_normal(const Mesh& mesh, const Patch& patch, std::string_view kind) {
  Vector normal = mesh.face_area[patch.first_face].normalized();
  for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
    if (mesh.face_area[f].normalized().dot(normal) < 1.0 - 1e-8)
      throw InputError(fmt::format("patch \"{}\" is not plane; a {} patch must be", patch.name, kind));
  return normal;
}

void add_plane(const Mesh& mesh, const PatchCondition& on, Unknowns& unknowns) {
  const Patch& patch = mesh.patches[on.patch];
  const Vector normal = plane_patch_normal(mesh, patch, "plane");
  const bool is_first = unknowns.plane_normal.isZero();
  if (!is_first && std::abs(normal.dot(unknowns.plane_normal)) < 1.0 - 1e-8)
    throw InputError(fmt::format("plane patch \"{}\" is not parallel to the other plane patches", patch.name));
  const bool plane_stress = on.condition.kind == BoundaryCondition::Kind::plane_stress;
  if (!is_first && plane_stress != unknowns.plane_stress)
    throw InputError(
        fmt::format("patch \"{}\" is of type \"{}\" and another one of type \"{}\"; the front and the back of a plate "
                    "are of one type: \"plane\" (plane strain) or \"plane_stress\"",
                    patch.name, plane_stress ? "plane_stress" : "plane", plane_stress ? "plane" : "plane_stress"));
  unknowns.plane_normal = normal;
  unknowns.plane_stress = plane_stress;
}

Tensor free_directions(const BoundaryCondition& condition, const Vector& face_area) {
  if (condition.kind == BoundaryCondition::Kind::symmetry) {
    const Vector n = face_area.normalized();
    return Tensor::Identity() - n * n.transpose();
  }
  Vector is_free;
  for (int i = 0; i < 3; ++i) is_free[i] = condition.displacement_prescribed[i] ? 0.0 : 1.0;
  return is_free.asDiagonal();
}

// Cells carry no gradient across the plane: each requires its front and its back, or the cells beyond would be held
// too.
void require_front_and_back(const Mesh& mesh, const Unknowns& unknowns) {
  if (unknowns.plane_normal.isZero()) return;
  std::vector<const PatchCondition*> of_face(mesh.n_faces(), nullptr);
  for (const PatchCondition& on : unknowns.conditions) {
    const Patch& patch = mesh.patches[on.patch];
    std::fill_n(of_face.begin() + patch.first_face, patch.n_faces, &on);
  }
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Index front = 0, back = 0;
    for (const Index f : mesh.faces_of_cell(c))
      if (of_face[f] != nullptr && is_front_or_back(of_face[f]->condition))
        ++(mesh.face_area[f].dot(unknowns.plane_normal) > 0.0 ? front : back);
    if (front > 0 && back > 0) continue;
    const Vector& x = mesh.cell_centre[c];
    throw InputError(fmt::format(
        "the types \"plane\" and \"plane_stress\" are for both sides, front and back, of a mesh that is one cell "
        "thick; "
        "the cell at ({:.4g}, {:.4g}, {:.4g}) m has {} of them: give both patches the type, or hold one side by "
        "\"symmetry\"",
        x[0], x[1], x[2], front + back == 0 ? "neither" : "one"));
  }
}

// Normal of a patch of a sector: its plane has to hold the axis z.
Vector sector_normal(const Mesh& mesh, const Patch& patch) {
  Vector normal = plane_patch_normal(mesh, patch, "axisymmetric");
  const Vector x = mesh.face_centre[patch.first_face];
  if (std::abs(normal.z()) > 1e-8 || std::abs(normal.dot(x)) > 1e-8 * x.norm())
    throw InputError(
        fmt::format("patch \"{}\" does not lie in a plane through the axis z; an axisymmetric patch must", patch.name));
  return normal;
}

// From the outward normals of the sector's two planes.
void place_sector(const std::vector<Vector>& normals, Unknowns& unknowns) {
  if (normals.empty()) return;
  if (unknowns.plane_normal.norm() > 0.0) throw InputError("plane and axisymmetric patches cannot be combined");
  if (normals.size() != 2 || !(normals[0].cross(normals[1]).norm() > 1e-6))
    throw InputError(
        "two axisymmetric patches are required, the planes of a sector that meet in the axis z, as \"front\" and "
        "\"back\"");
  unknowns.plane_normal = (normals[1] - normals[0]).normalized();
  unknowns.radial = -(normals[0] + normals[1]).normalized();
}

// In plane stress there is nothing that grows with lambda.
void place_pressures(const Mesh& mesh, const ElasticBody& body, Unknowns& unknowns) {
  if (unknowns.plane_stress || !body.has_pressure) return;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto by = body.volume_law ? body.volume_law(mesh, c)
                                    : std::optional<VolumeLaw>({.elasticity = unknowns.sound[unknowns.zone[c]]});
    if (!by || !(by->most_compressible || is_nearly_incompressible(by->elasticity))) continue;
    unknowns.pressure_cells.push_back(c);
    unknowns.pressure_laws.push_back(*by);
  }
}

// Also between two zones: the node of the interface is then the owner's.
template <class AddNode>
void split(const Mesh& mesh, const std::vector<Index>& faces, Unknowns& unknowns, const AddNode& add_node) {
  if (faces.empty()) return;
  unknowns.split_faces = faces;
  unknowns.neighbour_node = FaceField<Index>(mesh.n_faces(), -1);
  for (const Index f : faces) {
    if (unknowns.node_of_face[f] < 0) add_node(f, Tensor::Identity());
    unknowns.neighbour_node[f] = unknowns.n_nodes();
    unknowns.face_of_node.push_back(f);
    unknowns.free_directions.emplace_back(Tensor::Identity());
  }
}

void hold(const ElasticBody& body, Unknowns& unknowns) {
  unknowns.motion = body.motion;
  const auto number = [&](Index face) { return as_size(unknowns.node_of_face[face] - unknowns.n_cells); };
  for (const HeldFace& held : body.motion.held)
    unknowns.free_directions[number(held.face)] = Tensor::Identity() - held.directions;
  for (const PeriodicFaces& pair : body.motion.periodic) {
    unknowns.periodic.push_back({unknowns.node_of_face[pair.face], unknowns.node_of_face[pair.image]});
    unknowns.free_directions[number(pair.image)] = unknowns.free_directions[number(pair.face)];
  }
}

}  // namespace

bool is_nearly_incompressible(const IsotropicElasticity& elasticity) {
  return elasticity.poisson_ratio() > nearly_incompressible;
}

Unknowns place_floating_unknowns(const Mesh& mesh, const ElasticBody& body) {
  Unknowns unknowns;
  unknowns.n_cells = mesh.n_cells();
  unknowns.zone = elastic_zones(mesh, body);
  unknowns.sound = body.elasticity;
  unknowns.relaxed = body.relaxed.empty() ? body.elasticity : body.relaxed;
  unknowns.stiffness = body.stiffness;
  unknowns.loads = body.loads;
  unknowns.conditions = conditions_by_patch(mesh, body);
  unknowns.node_of_face = FaceField<Index>(mesh.n_faces(), -1);
  const auto add_node = [&](Index face, const Tensor& directions) {
    unknowns.node_of_face[face] = unknowns.n_nodes();
    unknowns.face_of_node.push_back(face);
    unknowns.free_directions.push_back(directions);
  };
  for (Index f = 0; f < mesh.n_interior_faces(); ++f)
    if (unknowns.zone[mesh.owner[f]] != unknowns.zone[mesh.neighbour[f]]) add_node(f, Tensor::Identity());
  split(mesh, body.split_faces, unknowns, add_node);
  std::vector<Vector> sector_normals;
  for (const PatchCondition& on : unknowns.conditions) {
    const Patch& patch = mesh.patches[on.patch];
    if (on.condition.kind == BoundaryCondition::Kind::axisymmetric) {
      sector_normals.push_back(sector_normal(mesh, patch));
      continue;
    }
    if (is_front_or_back(on.condition)) {
      add_plane(mesh, on, unknowns);
      continue;
    }
    if (on.condition.kind == BoundaryCondition::Kind::symmetry) plane_patch_normal(mesh, patch, "symmetry");
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      add_node(f, free_directions(on.condition, mesh.face_area[f]));
  }
  require_front_and_back(mesh, unknowns);
  place_sector(sector_normals, unknowns);
  hold(body, unknowns);
  place_pressures(mesh, body, unknowns);
  unknowns.spin_holds = spin_holds(mesh, unknowns);
  return unknowns;
}

CellField<IsotropicElasticity> Unknowns::sound_moduli() const {
  CellField<IsotropicElasticity> moduli(n_cells);
  for (Index c = 0; c < n_cells; ++c) moduli[c] = sound[zone[c]];
  return moduli;
}

std::vector<Vector> Unknowns::moved_with_box(const Mesh& mesh, double t) const {
  std::vector<Vector> u(n_unknowns(), Vector::Zero());
  for (Index i = 0; i < n_nodes(); ++i) u[i] = motion.displacement(place(mesh, i), t);
  return u;
}

Unknowns place_unknowns(const Mesh& mesh, const ElasticBody& body) {
  Unknowns unknowns = place_floating_unknowns(mesh, body);
  require_held(mesh, unknowns);
  return unknowns;
}

}  // namespace pfdm
