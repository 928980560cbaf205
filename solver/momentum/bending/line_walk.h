#pragma once
// Lines of cells through opposite faces: their way through a body, and the components that its faces hold.

#include "mesh/mesh.h"
#include "physics/elasticity/anisotropy.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/cubic_faces.h"
#include "solver/momentum/body/unknowns.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace pfdm {

/// Of each cell the faces of its sides with the sides' numbers.
using SidesOfCells = CellField<std::vector<std::pair<Index, std::size_t>>>;

inline SidesOfCells sides_of_cells(const Mesh& mesh, std::span<const CubicFaces::Side> sides) {
  SidesOfCells of_cells(mesh.n_cells());
  for (std::size_t k = 0; k < sides.size(); ++k) of_cells[sides[k].cell].emplace_back(sides[k].face, k);
  return of_cells;
}

class LineWalk {
 public:
  LineWalk(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {}

  /// A cell beyond a face in its line, and that cell's far face; no cell where the face carries a node.
  struct Step {
    Index cell = -1, far = -1;
  };
  Step beyond(Index cell, Index face) const {
    if (!mesh_.is_interior(face) || unknowns_.node_beside(mesh_, cell, face) >= 0) return {};
    const Index other = mesh_.across(face, cell);
    return {.cell = other, .far = opposite_face(mesh_, other, face)};
  }
  /// Between the centres of two faces [m].
  double length(Index f, Index g) const { return (mesh_.face_centre[g] - mesh_.face_centre[f]).norm(); }
  Vector place(std::size_t unknown) const { return unknowns_.place(mesh_, static_cast<Index>(unknown)); }
  /// The next cell from a face inwards; -1: none.
  Index cell_behind(Index cell, Index face) const { return beyond(cell, opposite_face(mesh_, cell, face)).cell; }

  /// Components on the surface of the body whose traction is prescribed, in plane meshes those within the plane.
  Tensor free_part(Index face) const {
    const Index node = unknowns_.node_of_face[face];
    if (mesh_.is_interior(face) || node < 0) return Tensor::Zero();
    return unknowns_.free_within(node);
  }
  bool is_free(Index face) const { return !free_part(face).isZero(); }
  /// Some components are held, others free, as on a plane of symmetry.
  bool is_mirror(Index face) const {
    const Vector& across = unknowns_.plane_normal;
    return is_free(face) && !(free_part(face) + across * across.transpose()).isIdentity();
  }
  bool is_bonded(Index face) const {
    return mesh_.is_interior(face) && !unknowns_.is_split(face) && unknowns_.node_of_face[face] >= 0;
  }

  /// Whether strains within layers that this face of a cell bounds shear them (layer_curvature.h).
  bool is_sheared(Index cell, Index face) const {
    const MandelMatrix* C = unknowns_.stiffness_of(mesh_, cell);
    return C != nullptr && !is_symmetric_about(*C, mesh_.face_area[face].normalized());
  }

  /// Whether the shear moduli of two cells differ by no more than this factor, at once and after any time.
  bool are_alike(Index cell, Index other, double most) const {
    return std::ranges::all_of(std::array{&unknowns_.sound, &unknowns_.relaxed}, [&](const auto* moduli) {
      const double here = (*moduli)[unknowns_.zone[cell]].mu, there = (*moduli)[unknowns_.zone[other]].mu;
      return std::max(here, there) <= most * std::min(here, there);
    });
  }

 private:
  const Mesh& mesh_;
  const Unknowns& unknowns_;
};

}  // namespace pfdm
