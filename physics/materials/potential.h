#pragma once
// Strain energies W(F) per reference volume with their derivatives, P = dW/dF and A = dP/dF (gradient_stress.h), put
// together from parts that are functions of the Green strain E = (F^T F - 1)/2 and of the volume J = det F.

#include "physics/elasticity/gradient_stress.h"
#include "physics/elasticity/mandel.h"

namespace pfdm {

/// Energy of volume changes U(J) over its modulus Lambda.
enum class VolumetricForm {
  quadratic,    ///< (J - 1)^2/2      (Kamarei, Zeng, Dolbow, Lopez-Pamies, CMAME 448 (2026) 118449)
  logarithmic,  ///< (J^2 - 1 - 2 ln J)/4  (Ciarlet, Geymonat, C. R. Acad. Sci. Paris 295 (1982) 423)
};

/// W [J/m^3], P [Pa] and A [Pa] at some H = F - 1.
struct PotentialAt {
  double energy = 0.0;
  Tensor stress = Tensor::Zero();
  GradientTangent tangent = GradientTangent::Zero();

  PotentialAt& operator+=(const PotentialAt& other) {
    energy += other.energy;
    stress += other.stress;
    tangent += other.tangent;
    return *this;
  }
};

/// A function of J: its value, slope and curvature.
struct OfVolume {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

/// E by H = F - 1, exact to rounding for small H [-].
inline Tensor green_strain(const Tensor& H) { return symmetric_part(H) + 0.5 * H.transpose() * H; }

/// P and A of an energy [J/m^3] whose derivatives by E are S and C [Pa].
PotentialAt by_gradient(double energy, const Tensor& F, const Mandel& S, const MandelMatrix& C);
/// Potential of a function of J at F.
PotentialAt by_volume(const Tensor& F, const OfVolume& f);

/// J from which on downwards functions of J go on as their expansions to second order, so that they are finite for
/// every F, also where a cell has turned inside out.
constexpr double least_volume = 0.1;
/// f(J - 1) at J - 1 = `change`, or its expansion about the least volume.
template <class Function>
OfVolume extended(double change, const Function& f) {
  if (1.0 + change >= least_volume) return f(change);
  const OfVolume at = f(least_volume - 1.0);
  const double by = 1.0 + change - least_volume;
  return {at.value + (at.slope + 0.5 * at.curvature * by) * by, at.slope + at.curvature * by, at.curvature};
}

/// U/Lambda at J - 1 = `change`. Its slope is the volume strain u that the pressure is proportional to, u = J - 1 or
/// (J - 1/J)/2.
OfVolume volume_energy(VolumetricForm form, double change);
/// u and its slopes [-] as the slope and the curvature of U/Lambda, of any J.
OfVolume extended_volume_energy(VolumetricForm form, double change);

}  // namespace pfdm
