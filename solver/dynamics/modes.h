#pragma once
// The lowest modes of a vibrating body, by Arnoldi's method on K^-1 M from a vector without symmetries.

#include "solver/dynamics/krylov_space.h"

namespace pfdm {

struct Mode {
  double omega = 0.0;      ///< [rad/s]
  Eigen::VectorXd shape;   ///< of all unknowns, with shape.M shape = 1 kg
  Vector participation{};  ///< shape.M e_k for a rigid motion e_k along each axis [kg]; its square over kg: the
                           ///< effective mass
};

/// In ascending order. Throws ComputationError if `count` modes are not found to `tolerance` of omega^2, or are not
/// real.
std::vector<Mode> lowest_modes(const VibratingBody& body, int count, double tolerance = 1e-9);

}  // namespace pfdm
