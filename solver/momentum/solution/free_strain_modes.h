#pragma once
// Motions of a box by each of its free strains (unknowns.h) while its other unknowns are in equilibrium. With these
// motions beside the preconditioner of the other unknowns,
//
//   z = M^-1 r + Phi (Phi^T A Phi)^-1 Phi^T r,
//
// the free strains no longer couple with them (A Phi has forces by the strains only), and they are found exactly. The
// motions are those of the sound body, to two digits: with damage they still span what is slow.

#include "solver/momentum/momentum.h"
#include "solver/momentum/solution/preconditioner.h"

#include <Eigen/Core>

#include <vector>

namespace pfdm {

class FreeStrainModes {
 public:
  /// `linear` null: the automatic choice.
  FreeStrainModes(const Mesh& mesh, const Unknowns& unknowns, const LinearSolver* linear)
      : mesh_(mesh), unknowns_(unknowns), linear_(linear) {}

  /// Builds the correction for the balance as it is now. The first call finds the motions.
  void build(const MomentumOperator& balance);
  /// z has to be zero in the free strains.
  void correct(const std::vector<Vector>& r, std::vector<Vector>& z) const;

 private:
  using Single = Eigen::Vector3f;
  void find_modes();
  Eigen::VectorXd projected(const std::vector<Vector>& r) const;

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  const LinearSolver* linear_;
  std::vector<std::vector<Single>> modes_;
  Eigen::MatrixXd give_;  // (modes, modes): their amplitudes by forces on them
};

}  // namespace pfdm
