#pragma once
// The surface of a body that fills a box, side by side. Faces inside the box (of voids and slits) belong to none.

#include "mesh/mesh.h"
#include "solver/momentum/body/unknowns.h"

#include <array>
#include <vector>

namespace pfdm {

struct BoxSides {
  Vector lower = Vector::Zero();  ///< corners [m]
  Vector upper = Vector::Zero();
  std::array<std::vector<Index>, 6> faces;  ///< of xmin, xmax, ymin, ymax, zmin, zmax

  double volume() const { return (upper - lower).prod(); }  ///< voids included [m^3]
  Vector centre() const { return 0.5 * (lower + upper); }
  std::vector<Index> all() const;
};

/// Throws InputError, naming the side, where the faces do not cover the sides of a box with its edges along x, y, z.
BoxSides find_box_sides(const Mesh& mesh);

/// Each face of xmin, ymin and zmin with its translate on the side opposite. Throws InputError, naming the sides, where
/// a face has none.
std::vector<PeriodicFaces> match_opposite_sides(const Mesh& mesh, const BoxSides& sides);

/// Three faces of zmin, near its corners, that are held against rigid motions and no strain: one in x, y, z, one in
/// y, z, one in z.
std::vector<HeldFace> three_two_one_supports(const Mesh& mesh, const BoxSides& sides);

}  // namespace pfdm
