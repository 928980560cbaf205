#include "physics/closed_forms/endochronic.h"

#include <cmath>

namespace pfdm {

double endochronic_tension(const KernelTerm& term, double f, double plastic_strain) {
  if (term.alpha == 0.0) return 3.0 * term.C * plastic_strain;
  const double zeta = std::sqrt(1.5) * plastic_strain;
  return -std::sqrt(6.0) * (term.C * f / term.alpha) * std::expm1(-term.alpha * zeta / f);
}

double endochronic_shear(const KernelTerm& term, double f, double plastic_shear) {
  if (term.alpha == 0.0) return term.C * plastic_shear;
  const double zeta = plastic_shear / std::sqrt(2.0);
  return -std::sqrt(2.0) * (term.C * f / term.alpha) * std::expm1(-term.alpha * zeta / f);
}

double endochronic_cyclic_peak(const KernelTerm& term, double half_amplitude) {
  return std::sqrt(6.0) * (term.C / term.alpha) * std::tanh(term.alpha * std::sqrt(1.5) * half_amplitude);
}

double endochronic_tension_linear_hardening(const KernelTerm& term, double b, double plastic_strain) {
  const double F = 1.0 + b * std::sqrt(1.5) * plastic_strain;
  return std::sqrt(6.0) * term.C / (term.alpha + b) * (F - std::pow(F, -term.alpha / b));
}

}  // namespace pfdm
