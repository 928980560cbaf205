#pragma once
// Derivatives along a surface, at the centres of its faces, by what a field is at the faces around them.

#include "mesh/mesh.h"

#include <functional>
#include <vector>

namespace pfdm {

/// Slopes along the faces of one patch.
class SurfaceSlopes {
 public:
  SurfaceSlopes(const Mesh& mesh, const Patch& patch);

  struct Sample {
    Index face;
    Vector d;            // from the centre of the face about which it is [m]
    Vector coefficient;  // within the plane of that face [1/m]
  };
  /// The gradient of v along a face is sum_j (v_j - v) coefficient_j, by least squares weighted by the squared
  /// distance. Its samples share a point with the face, lie beyond no edge of the surface, and count. It is zero in
  /// directions in which there are none.
  std::vector<Sample> at(Index face, const std::function<bool(Index face)>& counts) const;

 private:
  std::vector<Index> around(Index face) const;

  const Mesh& mesh_;
  std::vector<std::vector<Index>> faces_of_point_;
};

}  // namespace pfdm
