#pragma once
// Constrained Delaunay tetrahedra between triangulated surfaces (TetGen 1.5: Si, ACM Trans. Math. Softw. 41 (2015) 11).

#include <array>
#include <functional>
#include <vector>

#include "mesh/surfaces/triangle_surface.h"

namespace pfdm {

struct TetgenInput {
  struct Seed {
    Vector at;     ///< a point inside the region [m]
    Index region;  ///< the number its cells get
  };
  TriangleSurface surfaces;                          ///< all surfaces; kept as they are, no point is added to them
  std::vector<Vector> holes;                         ///< a point inside each part that is left empty [m]
  std::vector<Seed> seeds;                           ///< one for each part that is filled
  std::function<double(const Vector&)> wanted_size;  ///< edge length [m] wanted at a point
  double max_radius_edge_ratio = 1.4;                ///< circumradius over shortest edge [-]
  double min_dihedral_angle = 10.0;                  ///< [degrees]
};

struct TetgenOutput {
  std::vector<Vector> points;                    ///< [m]; the input's points first, in their order
  std::vector<std::array<Index, 4>> tetrahedra;  ///< of positive volume in VTK's order
  std::vector<Index> region;                     ///< of each tetrahedron
};

/// The same input gives the same output every time. In a process of its own: `wanted_size` starts no threads.
/// Throws InputError if the surfaces cross or come too close to each other, also where TetGen crashes on them,
/// ComputationError if TetGen gives up.
TetgenOutput tetrahedralize_regions(const TetgenInput& input);

}  // namespace pfdm
