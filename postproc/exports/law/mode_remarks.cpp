#include "postproc/exports/law/mode_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {

std::string quadratic_strength_remark(const ExportedLaw& law) {
  if (law.mix != ModeMix::benzeggagh_kenane || law.strength.value == law.shear_strength.value) return "";
  const double n2 = law.strength.value * law.strength.value, s2 = law.shear_strength.value * law.shear_strength.value;
  constexpr int samples = 200;
  double low = 1.0, high = 1.0;  // of the quadratic strength over the rule's
  for (int i = 0; i <= samples; ++i) {
    const double B = double(i) / samples;
    const double here = 1.0 / ((1.0 - B) / n2 + B / s2), there = n2 + (s2 - n2) * std::pow(B, law.exponent.value);
    low = std::min(low, std::sqrt(here / there)), high = std::max(high, std::sqrt(here / there));
  }
  return fmt::format(
      "Between the modes damage begins where (T_n/s_n)^2 + (T_s/s_s)^2 = 1, by the rule of the law at strength^2 = "
      "s_n^2 + (s_s^2 - s_n^2) B^exponent: with {:.3g} to {:.3g} times the strength. The energies are the law's.",
      low, high);
}

std::string one_stiffness_remark(const ExportedLaw& law) {
  if (law.has_one_stiffness()) return "";
  return fmt::format(
      "One stiffness for all modes: that in shear, {:.4g} times the normal one, has no place. An opened interface "
      "pulls "
      "along its separation; the law has {:.4g} times that ratio of the shear to the normal traction. In either mode "
      "alone only the rise to the strength differs.",
      law.shear_stiffness.value / law.stiffness.value, law.shear_stiffness.value / law.stiffness.value);
}

std::string shear_stiffness_remark(const ExportedLaw& law, double stiffness) {
  constexpr double rounding = 1e-9;
  if (std::abs(stiffness - law.shear_stiffness.value) <= rounding * stiffness) return "";
  return fmt::format("In shear the stiffness is {:.4g} times that of the law.", stiffness / law.shear_stiffness.value);
}

}  // namespace pfdm
