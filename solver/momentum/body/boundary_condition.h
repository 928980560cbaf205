#pragma once
// Boundary conditions on patches.

#include "physics/tensor.h"

#include <array>
#include <functional>
#include <string>

namespace pfdm {

/// Springs between a surface and the ground, per reference area.
struct FoundationStiffness {
  double across = 0.0, along = 0.0;  ///< k_n, along the normal, and k_t, along the surface [N/m^3]

  /// K of the traction t = -K u on a surface with the unit normal n [N/m^3].
  Tensor tensor(const Vector& n) const { return along * Tensor::Identity() + (across - along) * n * n.transpose(); }
};

struct BoundaryCondition {
  enum class Kind {
    components,    ///< each Cartesian component is a displacement or a traction
    symmetry,      ///< no normal displacement, no tangential traction
    plane,         ///< front or back of a mesh one cell thick: plane strain, the cells carry no gradient across it
    plane_stress,  ///< front or back of a mesh one cell thick: no stress across it
    axisymmetric,  ///< front or back of a sector about the axis z, one cell wide: the cells stretch by u_r / r across
                   ///< it
    elastic_foundation,  ///< traction t = -(k_n u.n n + k_t (u - u.n n)) (Robin; Winkler foundation), n the normal of
                         ///< the undeformed surface also at finite strain
  };
  std::string patch;
  Kind kind = Kind::components;
  std::array<bool, 3> displacement_prescribed{false, false, false};  ///< otherwise that component is a traction
  /// Components: displacement [m] where prescribed, traction [Pa] elsewhere; x [m], load parameter t [-].
  /// Empty means zero everywhere.
  std::function<Vector(const Vector& x, double t)> value;
  /// Components: pressure [Pa] that pushes against the face, in the directions in which it is free, beside the
  /// traction; at finite strain on the current area (a follower load). Empty means none.
  std::function<double(const Vector& x, double t)> pressure{};
  /// Elastic foundation: its stiffness at x [m].
  std::function<FoundationStiffness(const Vector& x)> foundation{};
};

/// Faces of such patches carry no unknown.
inline bool is_front_or_back(const BoundaryCondition& condition) {
  using Kind = BoundaryCondition::Kind;
  return condition.kind == Kind::plane || condition.kind == Kind::plane_stress || condition.kind == Kind::axisymmetric;
}

}  // namespace pfdm
