#pragma once
// The springs between the two sides of split faces (cohesive interfaces). Each side has a node and a traction of its
// own, and a law of their separation joins them, t_P = T(u_N - u_P) = -t_N, linearised within each solve.

#include "solver/linear/block_matrix.h"
#include "solver/momentum/faces/face_skeleton.h"

#include <vector>

namespace pfdm {

/// The law of a split face about a separation delta = u_N - u_P of its sides.
struct FaceSpring {
  Tensor stiffness;  ///< K of the traction on the owner's side, K delta + offset [Pa/m]
  Vector offset;     ///< [Pa]
  Tensor secant;     ///< for the preconditioner: symmetric, positive semi-definite [Pa/m]
  /// Change of the traction at finite strain with cof F N of the owner and of the neighbour [Pa]. The offset is then
  /// that of a traction K delta + offset + turn_P (dc_P/dF : H_P) N + turn_N (dc_N/dF : H_N) N.
  Tensor turn_P = Tensor::Zero(), turn_N = Tensor::Zero();
};

class FaceSprings {
 public:
  explicit FaceSprings(const FaceSkeleton& skeleton) : skeleton_(skeleton) {}

  /// Springs in the order of the split faces; empty: none.
  const std::vector<FaceSpring>& all() const { return springs_; }
  void set(std::vector<FaceSpring> springs) { springs_ = std::move(springs); }

  /// Displacement of the neighbour's side of split face number k, less that of the owner's [m].
  Vector separation(std::size_t k, const std::vector<Vector>& u) const {
    const momentum_faces::SplitFace& face = skeleton_.split_faces[k];
    return u[face.beyond] - u[face.node];
  }
  /// A K delta per split face, on the owner's side [N].
  std::vector<Vector> forces(const std::vector<Vector>& u) const;
  /// out -= such forces on the nodes [N].
  void pull(const std::vector<Vector>& forces, std::vector<Vector>& out) const;
  /// load += the forces of the offsets [N].
  void add_offsets(std::vector<Vector>& load) const;
  /// matrix += their secants.
  void add_to(BlockTriplets& matrix) const;

 private:
  const FaceSkeleton& skeleton_;
  std::vector<FaceSpring> springs_;
};

}  // namespace pfdm
