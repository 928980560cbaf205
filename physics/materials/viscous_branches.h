#pragma once
// Maxwell branches of a hyperelastic material at finite strain: each a spring with a shear modulus mu_i in series with
// a dashpot, F = F_e F_v, C_v = F_v^T F_v with det C_v = 1 (Reese, Govindjee, Int. J. Solids Struct. 35 (1998) 3455;
// Kumar, Lopez-Pamies, C. R. Mecanique 344 (2016) 102). Beside the relaxed elasticity each stores, with J = det F and
// C' = J^(-2/3) C,
//
//   W_i = mu_i/2 J^(2/3) (C':C_v^-1 - 3),   C_v' = (C' - (C':C_v^-1)/3 C_v)/tau_i,
//
// nothing by volume changes, which are elastic. At small strain it is the shear branch of a Prony series (prony.h). A
// step takes the flow's equation with C' linear in the step and r = (C':C_v^-1)/3 of its start, x = r dt/tau,
//
//   M = e^-x C_v + ((phi - e^-x) C'_n + (1 - phi) C')/r,   C_v = M/(det M)^(1/3),   phi = (1 - e^-x)/x:
//
// exact at small strain, second order beyond. The stress is that of the state at the end of the step, and the tangent
// belongs to it; it is not symmetric. The heat, with B = J^(1/3) dev(C' C_v^-1), is the integral of mu_i/(2 tau_i)
// B:B^T over the step, B taken as that of a spring of small strain (prony_decay.h): never negative, none of what is at
// once.
//
// Cells with a pressure: the moderate volumetric stress K_s u of the cell relaxes as its shear modulus does
// (relaxing_gaps.h). A branch then has a spring in bulk, of the modulus bulk_ratio mu_i, that bears v_i, v_i' +
// v_i/tau_i = u', u being the volume strain of U (potential.h). The pressure takes away what the springs bear, so that
// the whole material stores and dissipates nothing by it: energies are without.
//
// Branches of volume changes (volume_branches.h) come beside them.

#include "physics/materials/potential.h"
#include "physics/materials/prony.h"
#include "physics/materials/volume_branches.h"

#include <span>
#include <vector>

namespace pfdm {

/// What a point was at the start of a step. `history` as ViscousBranches::size() says; a step of no duration holds it.
struct PointBefore {
  Tensor from = Tensor::Zero();  ///< H [-]
  double duration = 0.0;         ///< [s]
  std::span<const double> history{};
};

class ViscousBranches {
 public:
  ViscousBranches() = default;  ///< none
  /// The shear and the bulk branches of a law. bulk_ratio: bulk modulus over shear modulus of the springs of the
  /// former [-], 0: none.
  ViscousBranches(const std::vector<PronyBranch>& shear, VolumetricForm form, double bulk_ratio,
                  const std::vector<PronyBranch>& bulk = {});

  bool any() const { return heat_ > 0; }
  /// Numbers of a history: C_v - 1 of each shear branch in Mandel components, volume strains of their springs if there
  /// is a bulk ratio, what the bulk branches have, then the heat [J/m^3]. All are zero in the virgin state.
  std::size_t size() const { return any() ? heat_ + 1 : 0; }
  /// Sum of mu_i phi_i [Pa]: what a small change of strain meets in a step besides the relaxed shear modulus.
  double modulus_over(double duration) const;
  /// Likewise of the bulk branches, besides the relaxed bulk modulus [Pa].
  double bulk_modulus_over(double duration) const { return volume_.modulus_over(duration); }

  /// Energy, stress and consistent tangent at the end H of a step; finite for every H.
  PotentialAt over(const Tensor& H, const PointBefore& before) const;
  /// Writes the history at the end H of a step.
  void advance(const Tensor& H, const PointBefore& before, std::span<double> history) const;
  /// Energy dissipated as heat since the virgin state [J/m^3].
  double heat(std::span<const double> history) const { return any() ? history[heat_] : 0.0; }

 private:
  struct Shape;  // of a deformation
  struct Flow;   // of a branch in a step
  Flow flow(std::size_t branch, const Shape& now, const Shape& before, const PointBefore& at) const;
  PotentialAt force(std::size_t branch, const Tensor& F, const Shape& now, const Flow& flow) const;
  PotentialAt shear(std::size_t branch, const Tensor& F, const Shape& now, const Flow& flow) const;
  double dissipated(std::size_t branch, const Shape& now, const Shape& before, const PointBefore& at,
                    const Flow& flow) const;
  double spring(std::size_t branch, const Shape& now, const Shape& before, const PointBefore& at) const;
  VolumeBranches::Step volume_step(const Shape& now, const Shape& before, const PointBefore& at) const;

  std::vector<PronyBranch> branches_;
  VolumetricForm form_;
  double bulk_ratio_ = 0.0;
  VolumeBranches volume_;
  std::size_t springs_ = 0, volumes_ = 0, heat_ = 0;  // places in the history
};

}  // namespace pfdm
