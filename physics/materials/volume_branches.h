#pragma once
// Maxwell branches of volume changes of a hyperelastic material at finite strain: each a spring with a bulk modulus K_j
// in series with a dashpot, J = J_e J_v. Beside the relaxed elasticity each stores, U being the volume energy of the
// material over its modulus (potential.h),
//
//   W_j = K_j U(J_e),   (ln J_v)' = ln J_e/tau_j,
//
// and dissipates K_j J_e U'(J_e) ln J_e/tau_j, which is never negative. So r = ln J_e is a Maxwell branch of ln J, r' +
// r/tau = (ln J)', and a step in which ln J changes linearly is exact. At small strain it is the bulk branch of a Prony
// series (prony.h). The stress is that of the state at the end of the step, the tangent belongs to it. The heat of a
// step is as of shear branches (viscous_branches.h), by q^2 = J_e U' ln J_e.

#include "physics/materials/potential.h"
#include "physics/materials/prony.h"

#include <span>
#include <vector>

namespace pfdm {

class VolumeBranches {
 public:
  VolumeBranches() = default;  ///< none
  VolumeBranches(const std::vector<PronyBranch>& branches, VolumetricForm form) : branches_(branches), form_(form) {}

  /// Numbers of a history: r of each branch [-], zero in the virgin state.
  std::size_t size() const { return branches_.size(); }
  /// Sum of K_j phi_j [Pa]: what a small change of volume meets in a step besides the relaxed bulk modulus.
  double modulus_over(double duration) const;

  /// A step of the volume, J - 1 from `from` to `to`, from a history; one of no duration holds it.
  struct Step {
    double from = 0.0, to = 0.0;  ///< [-]
    double duration = 0.0;        ///< [s]
    std::span<const double> history{};
  };
  /// Energy [J/m^3], dW/dJ at constant J_v and the derivative of that in the step [Pa], at its end; finite at any J.
  OfVolume over(const Step& step) const;
  /// Writes the history at the end of a step, and returns the heat that it makes [J/m^3].
  double advance(const Step& step, std::span<double> history) const;

 private:
  double strain(std::size_t branch, const Step& step) const;
  double dissipated(std::size_t branch, double from, double to, double duration) const;

  std::vector<PronyBranch> branches_;
  VolumetricForm form_ = VolumetricForm::quadratic;
};

}  // namespace pfdm
