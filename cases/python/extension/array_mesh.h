#pragma once
// A mesh of arrays, as a mesh file would have it.

#include "cases/python/extension/arrays.h"
#include "mesh/mesh.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace pfdm {

/// Cells as VTK has them; triangles and quadrilaterals among them tell patches.
struct MeshArrays {
  ArrayOf<double> points;                         ///< (n_points, 3) [m]
  ArrayOf<std::int64_t> connectivity, offsets;    ///< points of all cells; where each ends, (n_cells,)
  ArrayOf<int> types;                             ///< (n_cells,), VTK's numbers
  std::optional<ArrayOf<Index>> numbers;          ///< (n_cells,): of a cell's region, of a face's patch
  std::map<Index, std::string> regions, patches;  ///< names of the numbers; else region_<number>, patch_<number>
  /// Of each polyhedron in turn n_faces, then of each of its faces n_points and the points.
  std::optional<ArrayOf<std::int64_t>> faces;
};

/// As Python hands them over: the members in their order.
using MeshTuple = std::tuple<ArrayOf<double>, ArrayOf<std::int64_t>, ArrayOf<std::int64_t>, ArrayOf<int>,
                             std::optional<ArrayOf<Index>>, std::map<Index, std::string>, std::map<Index, std::string>,
                             std::optional<ArrayOf<std::int64_t>>>;
std::optional<MeshArrays> arrays_of(const std::optional<MeshTuple>& given);

/// Needs no lock of the interpreter. Throws InputError for arrays that do not fit together, and for what is wrong with
/// the mesh, as of a file.
Mesh mesh_of(const MeshArrays& arrays);

}  // namespace pfdm
