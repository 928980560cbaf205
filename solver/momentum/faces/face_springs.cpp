#include "solver/momentum/faces/face_springs.h"

#include "solver/parallel.h"

namespace pfdm {

using momentum_faces::SplitFace;

std::vector<Vector> FaceSprings::forces(const std::vector<Vector>& u) const {
  std::vector<Vector> forces(springs_.size());
  parallel_for(count_of(springs_), [&](Index k) {
    forces[k] = skeleton_.split_faces[k].area * (springs_[k].stiffness * separation(k, u));
  });
  return forces;
}

void FaceSprings::pull(const std::vector<Vector>& forces, std::vector<Vector>& out) const {
  parallel_for(count_of(forces), [&](Index i) {
    const SplitFace& face = skeleton_.split_faces[i];
    out[face.node] -= forces[i];
    out[face.beyond] += forces[i];
  });
}

void FaceSprings::add_offsets(std::vector<Vector>& load) const {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const SplitFace& face = skeleton_.split_faces[k];
    load[face.node] += face.area * springs_[k].offset;
    load[face.beyond] -= face.area * springs_[k].offset;
  }
}

void FaceSprings::add_to(BlockTriplets& matrix) const {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const SplitFace& face = skeleton_.split_faces[k];
    const Tensor s = face.area * springs_[k].secant;
    matrix.diagonal[face.node] += s;
    matrix.diagonal[face.beyond] += s;
    matrix.off_diagonal.push_back({face.node, face.beyond, -s});
  }
}

}  // namespace pfdm
