#include "solver/momentum/faces/bonded_sides.h"

#include "solver/momentum/faces/surface_slopes.h"

#include <algorithm>

namespace pfdm {
namespace {

// Hexahedra and prisms behind their ends have another face opposite to this one, with the same direction across both.
bool has_opposite(const Mesh& mesh, const momentum_faces::Side& side) {
  const CellShape shape = mesh.shape[side.cell];
  return shape == CellShape::hexahedron || (shape == CellShape::wedge && mesh.points_of_face(side.face).size() == 3);
}

}  // namespace

BondedSides::BondedSides(const Mesh& mesh, const Unknowns& unknowns, const std::vector<momentum_faces::Side>& sides,
                         const std::function<bool(Index cell)>& may_be) {
  if (unknowns.pressure_cells.empty()) return;
  std::vector<char> has_pressure(mesh.n_cells(), 0);
  for (const Index c : unknowns.pressure_cells) has_pressure[c] = may_be(c) ? 1 : 0;
  number_.assign(sides.size(), -1);
  if (unknowns.is_axisymmetric()) {
    radial_ = unknowns.radial, across_ = unknowns.plane_normal;
    hoop_ = across_ * across_.transpose();
  }
  std::vector<Index> side_of_face(mesh.n_faces(), -1);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!mesh.is_interior(sides[i].face) && has_pressure[sides[i].cell] != 0 && has_opposite(mesh, sides[i]) &&
        unknowns.free_within(sides[i].node).isZero())
      side_of_face[sides[i].face] = static_cast<Index>(i);
  for (const Patch& patch : mesh.patches) {
    const Index end = patch.first_face + patch.n_faces;
    if (std::all_of(side_of_face.begin() + patch.first_face, side_of_face.begin() + end, [](Index i) { return i < 0; }))
      continue;
    const SurfaceSlopes slopes(mesh, patch);
    for (Index f = patch.first_face; f < end; ++f) {
      const Index i = side_of_face[f];
      if (i < 0) continue;
      number_[i] = static_cast<Index>(size());
      side_.push_back(i);
      add(mesh, unknowns, sides[i], slopes);
    }
  }
  if (size() == 0) number_.clear();
}

void BondedSides::add(const Mesh& mesh, const Unknowns& unknowns, const momentum_faces::Side& side,
                      const SurfaceSlopes& slopes) {
  node_.push_back(side.node);
  if (unknowns.is_axisymmetric()) radius_.push_back(radial_.dot(mesh.face_centre[side.face]));
  const auto is_held = [&](Index face) {
    const Index node = unknowns.node_of_face[face];
    return node >= 0 && unknowns.free_within(node).isZero();
  };
  for (const SurfaceSlopes::Sample& of : slopes.at(side.face, is_held))
    samples_.push_back({.node = unknowns.node_of_face[of.face], .d = of.d, .coefficient = of.coefficient});
  offsets_.push_back(samples_.size());
}

}  // namespace pfdm
