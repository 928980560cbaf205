#pragma once
// Free deformation of a point at finite strain, as of heating, swelling or shrinkage: F = F_e F*, where F* = 1 + eps*
// deforms the material without stress and F_e is elastic. The energy per reference volume is J* W(F_e), J* = det F*
// (Lubarda, Appl. Mech. Rev. 57 (2004) 95, secs. 2 and 3; Vujosevic, Lubarda, Theor. Appl. Mech. 28-29 (2002) 379), so
//
//   P = J* P_e(F_e) F*^-T,   dP/dF = J* A_e with both material indices pushed by F*^-1,
//   dW/dF* at constant F = W F*^-T - F_e^T P.
//
// eps* is symmetric. Thermal expansion: F* = (1 + alpha dT) 1.

#include "physics/elasticity/gradient_stress.h"

namespace pfdm {

class FreeDeformation {
 public:
  FreeDeformation() = default;  ///< none
  /// Free deformation by the eigenstrain eps* [-], symmetric and with principal values above -1.
  explicit FreeDeformation(const Tensor& eigenstrain)
      : strain_(eigenstrain),
        inverse_((Tensor::Identity() + eigenstrain).inverse()),
        change_(volume_change(eigenstrain)) {}

  bool is_none() const { return (strain_.array() == 0.0).all(); }
  double volume() const { return 1.0 + change_; }                  ///< J* [-]
  double change() const { return change_; }                        ///< J* - 1 [-], exact to rounding for small eps*
  Tensor stretch() const { return Tensor::Identity() + strain_; }  ///< F* [-]
  const Tensor& inverse() const { return inverse_; }               ///< F*^-1 [-]

  /// F_e - 1 by H = F - 1, and back [-].
  Tensor elastic(const Tensor& H) const { return (H - strain_) * inverse_; }
  Tensor total(const Tensor& elastic) const { return elastic * stretch() + strain_; }
  /// J/J* - 1 by J - 1 [-].
  double elastic_change(double change) const { return (change - change_) / volume(); }

  /// P [Pa], per reference area, by P_e = dW/dF_e.
  Tensor stress(const Tensor& elastic) const { return volume() * elastic * inverse_.transpose(); }
  /// dP/dF [Pa] by dP_e/dF_e.
  GradientTangent tangent(const GradientTangent& elastic) const {
    GradientTangent A;
    for (Index i = 0; i < 3; ++i)
      for (Index k = 0; k < 3; ++k)
        A.block<3, 3>(3 * i, 3 * k) = volume() * inverse_ * elastic.block<3, 3>(3 * i, 3 * k) * inverse_.transpose();
    return A;
  }
  /// dW/dF* [Pa] at constant F: by the energy W per reference volume [J/m^3], P and H.
  Tensor energy_slope(double energy, const Tensor& P, const Tensor& H) const {
    return energy * inverse_.transpose() - (Tensor::Identity() + elastic(H)).transpose() * P;
  }

 private:
  Tensor strain_ = Tensor::Zero(), inverse_ = Tensor::Identity();
  double change_ = 0.0;
};

}  // namespace pfdm
