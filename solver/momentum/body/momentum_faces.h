#pragma once
// The faces of the momentum balance as the cells beside them see them.

#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>

namespace pfdm::momentum_faces {

/// An interior face within one elastic zone: it carries no unknown.
struct Link {
  Index face, P, N;  ///< owner and neighbour
  double area;       ///< [m^2]
  Vector n;          ///< from P to N
  Vector d_P, d_N;   ///< from the cell centres to the face centre [m]

  double h_P() const { return std::abs(d_P.dot(n)); }  ///< distance of P's centre from the face's plane [m]
  double h_N() const { return std::abs(d_N.dot(n)); }
};

/// One side of a face that carries a node.
struct Side {
  Index face, cell, node;
  double area;  ///< [m^2]
  Vector n;     ///< outwards from the cell
  Vector d;     ///< from the cell centre to the face centre [m]

  double h() const { return std::abs(d.dot(n)); }  ///< [m]
};

/// An interior face whose two sides each have a node.
struct SplitFace {
  Index node, beyond;  ///< on the owner's and on the neighbour's side
  double area;         ///< [m^2]
  Index P, N;          ///< owner and neighbour
  Vector n;            ///< from P to N
};

/// The stiffness of a link's two sides where it is a tensor.
struct LinkTensors {
  Tensor weight;    ///< b (a + b)^-1, of sigma_P n in the traction; its transpose is (a + b)^-1 b
  Tensor c;         ///< of the jump [Pa/m]
  Tensor softness;  ///< (a + b)^-1 [m/Pa]
};

/// (across I + (along - across) n n^T) v for a unit normal n.
inline Vector scale(double along, double across, const Vector& n, const Vector& v) {
  return across * v + ((along - across) * n.dot(v)) * n;
}

/// Distance [m] of a cell's centre from the plane of its face. A centre that lies almost in the plane would make the
/// face too stiff.
inline double bounded_height(const Vector& d, const Vector& n) { return std::max(std::abs(d.dot(n)), 1e-3 * d.norm()); }

}  // namespace pfdm::momentum_faces
