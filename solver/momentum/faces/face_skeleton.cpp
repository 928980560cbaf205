#include "solver/momentum/faces/face_skeleton.h"

#include "solver/parallel.h"

namespace pfdm {
using momentum_faces::Link;
using momentum_faces::Side;
namespace {

CellField<Tensor> closures(const Mesh& mesh) {
  CellField<Tensor> closure(mesh.n_cells());
  parallel_for(mesh.n_cells(), [&](Index c) {
    Tensor K = Tensor::Zero();
    for (const Index f : mesh.faces_of_cell(c))
      K += mesh.outward_area(f, c) * (mesh.face_centre[f] - mesh.cell_centre[c]).transpose();
    closure[c] = (K / mesh.cell_volume[c]).inverse();
  });
  return closure;
}

// Sector areas of axisymmetric meshes; empty for others.
CellField<Vector> sector_areas(const Mesh& mesh, const Unknowns& unknowns) {
  if (!unknowns.is_axisymmetric()) return {};
  CellField<Vector> area(mesh.n_cells(), Vector::Zero());
  for (const PatchCondition& on : unknowns.conditions) {
    if (on.condition.kind != BoundaryCondition::Kind::axisymmetric) continue;
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      area[mesh.owner[f]] += mesh.face_area[f];
  }
  return area;
}

}  // namespace

FaceSkeleton::FaceSkeleton(const Mesh& of, const Unknowns& placed)
    : mesh(of),
      unknowns(placed),
      force_of_face(of.n_faces(), -1),
      first_side_of_node(placed.face_of_node.size(), -1),
      second_side_of_node(placed.face_of_node.size(), -1),
      closure(closures(of)),
      sector_area(sector_areas(of, placed)) {
  add_links();
  add_sides();
  list_forces_of_cells();
}

std::vector<MovedFaces::Place> FaceSkeleton::places_by_force() const {
  std::vector<MovedFaces::Place> places;
  places.reserve(links.size() + sides.size());
  for (const Link& link : links) places.push_back({.face = link.face, .cell = link.P, .beyond = link.N});
  for (std::size_t i = 0; i < sides.size(); ++i)
    places.push_back({.face = sides[i].face, .cell = sides[i].cell, .node = sides[i].node, .side = i});
  return places;
}

std::vector<CubicFaces::Side> FaceSkeleton::sides_by_turn() const {
  std::vector<CubicFaces::Side> by_turn;
  by_turn.reserve(2 * links.size() + sides.size());
  for (const Link& link : links) {
    by_turn.push_back({.cell = link.P, .face = link.face});
    by_turn.push_back({.cell = link.N, .face = link.face});
  }
  for (const Side& side : sides) by_turn.push_back({.cell = side.cell, .face = side.face});
  return by_turn;
}

void FaceSkeleton::add_links() {
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    if (unknowns.node_of_face[f] >= 0) continue;
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    force_of_face[f] = count_of(links);
    links.push_back({.face = f,
                     .P = P,
                     .N = N,
                     .area = mesh.face_area[f].norm(),
                     .n = mesh.face_area[f].normalized(),
                     .d_P = mesh.face_centre[f] - mesh.cell_centre[P],
                     .d_N = mesh.face_centre[f] - mesh.cell_centre[N]});
  }
}

void FaceSkeleton::add_sides() {
  const auto add = [&](Index node, Index f, Index cell, double sign) {
    sides.push_back({.face = f,
                     .cell = cell,
                     .node = node,
                     .area = mesh.face_area[f].norm(),
                     .n = sign * mesh.face_area[f].normalized(),
                     .d = mesh.face_centre[f] - mesh.cell_centre[cell]});
    return count_of(sides) - 1;
  };
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    const Index f = unknowns.face_of_node[k], node = unknowns.n_cells + static_cast<Index>(k);
    if (node != unknowns.node_of_face[f]) {
      first_side_of_node[k] = add(node, f, mesh.neighbour[f], -1.0);
      continue;
    }
    first_side_of_node[k] = add(node, f, mesh.owner[f], 1.0);
    force_of_face[f] = count_of(links) + first_side_of_node[k];
    const bool shared = mesh.is_interior(f) && unknowns.node_beside(mesh, mesh.neighbour[f], f) == node;
    if (shared) second_side_of_node[k] = add(node, f, mesh.neighbour[f], -1.0);
  }
  for (const Index f : unknowns.split_faces)
    split_faces.push_back({.node = unknowns.node_of_face[f],
                           .beyond = unknowns.neighbour_node[f],
                           .area = mesh.face_area[f].norm(),
                           .P = mesh.owner[f],
                           .N = mesh.neighbour[f],
                           .n = mesh.face_area[f].normalized()});
}

void FaceSkeleton::list_forces_of_cells() {
  cell_offsets_.push_back(0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    for (const Index f : mesh.faces_of_cell(c)) {
      const Index force = force_of_face[f], node = unknowns.node_beside(mesh, c, f);
      if (force < 0) continue;
      if (mesh.owner[f] == c) {
        cell_forces_.push_back({force, 1.0});
      } else if (node < 0) {
        cell_forces_.push_back({force, -1.0});
      } else {
        const std::size_t k = node - unknowns.n_cells;
        const Index side = second_side_of_node[k] >= 0 ? second_side_of_node[k] : first_side_of_node[k];
        cell_forces_.push_back({count_of(links) + side, 1.0});
      }
    }
    cell_offsets_.push_back(cell_forces_.size());
  }
}

void FaceSkeleton::sum_forces(const FaceForces& forces, std::vector<Vector>& out) const {
  parallel_for(mesh.n_cells(), [&](Index c) {
    Vector sum = Vector::Zero();
    for (const SignedForce& on : forces_of(c)) sum += on.sign * forces.force[on.force];
    if (sector_area.size() > 0) sum += forces.sector_stress[c] * sector_area[c];
    out[c] = -sum;
  });
  const std::size_t n_links = links.size();
  parallel_for(count_of(first_side_of_node), [&](Index k) {
    Vector sum = forces.force[n_links + first_side_of_node[k]];
    if (const Index second = second_side_of_node[k]; second >= 0) sum += forces.force[n_links + second];
    out[unknowns.n_cells + k] = unknowns.free_directions[k] * sum;
  });
  gather_from_images(out);
  work_on_free_strains(forces, out);
  keep_in_plane(out);
}

void FaceSkeleton::keep_in_plane(std::vector<Vector>& v) const {
  const Vector& n = unknowns.plane_normal;
  if (n.isZero()) return;
  parallel_for(unknowns.n_nodes(), [&](Index i) { v[i] -= n.dot(v[i]) * n; });
}

void FaceSkeleton::gather_from_images(std::vector<Vector>& forces) const {
  for (const PeriodicNodes& pair : unknowns.periodic) {
    forces[pair.node] += forces[pair.image];
    forces[pair.image].setZero();
  }
}

// From the forces on the faces, which `out` has not where they are held.
void FaceSkeleton::work_on_free_strains(const FaceForces& forces, std::vector<Vector>& out) const {
  const BoxMotion& motion = unknowns.motion;
  if (!unknowns.has_free_strains()) return;
  const auto force_on = [&](Index node) { return forces.force[links.size() + first_side_of_node[number_of(node)]]; };
  Tensor moment = Tensor::Zero();
  for (const HeldFace& held : motion.held) {
    const Index node = unknowns.node_of_face[held.face];
    Vector force = force_on(node);
    for (const PeriodicNodes& pair : unknowns.periodic)
      if (pair.node == node) force += force_on(pair.image);  // which moves with it
    moment += held.directions * force * (mesh.face_centre[held.face] - motion.centre).transpose();
  }
  for (const PeriodicNodes& pair : unknowns.periodic)
    moment += force_on(pair.image) * (unknowns.place(mesh, pair.image) - unknowns.place(mesh, pair.node)).transpose();
  for (std::size_t k = 0; k < motion.free_strains.size(); ++k)
    out[unknowns.first_strain() + k] = contract(motion.free_strains[k].direction, moment) * Vector::UnitX();
}

void FaceSkeleton::move_images(std::vector<Vector>& v) const {
  for (const PeriodicNodes& pair : unknowns.periodic) v[pair.image] = v[pair.node];
}

}  // namespace pfdm
