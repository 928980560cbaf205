#include "postproc/exports/law/law_parts.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double rise_share = 0.01;      // of the final separation, that the rule for K gives to the rise
constexpr double least_traction = 0.02;  // part of the strength below which a secant is rounding

}  // namespace

double own_compliance(std::span<const TractionPoint> states, double strength) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto [separation, traction] : states) {
    if (traction >= least_traction * strength) least = std::min(least, std::max(0.0, separation) / traction);
    if (traction >= strength) break;
  }
  return std::isfinite(least) ? least : 0.0;
}

Figure stiffness_of(const ExportedLaw& law, double compliance, const ExportChoice& choice) {
  const double strength = law.strength.value, energy = law.energy.value;
  const double least = 0.5 * strength * strength / energy;  // its rise takes the whole energy
  constexpr double most = 1e6;  // times the least: the rise is shorter than anything that a mesh or a table resolves
  if (choice.stiffness && *choice.stiffness > most * least)
    throw InputError(fmt::format("--stiffness {}: at most {:g} strength^2 / (2 GI) = {}",
                                 quantity_text(*choice.stiffness, "Pa/m"), most, quantity_text(most * least, "Pa/m")));
  if (choice.stiffness) {
    if (*choice.stiffness > least) return {*choice.stiffness, "given (--stiffness)"};
    throw InputError(fmt::format("--stiffness {}: the law needs more than strength^2 / (2 GI) = {}",
                                 quantity_text(*choice.stiffness, "Pa/m"), quantity_text(least, "Pa/m")));
  }
  const double rule = least / rise_share;
  const double value = 1.0 / (1.0 / rule + compliance);
  return {std::max(value, 1.02 * least),
          compliance * rule < 1e-3 ? "rule: 50 strength^2/GI (else --stiffness)"
                                   : "rule: 50 strength^2/GI in series with the law's own rise (else --stiffness)"};
}

Figure shear_stiffness_of(const ExportedLaw& law) {
  const double b2 = law.shear_ratio() * law.shear_ratio();
  if (law.mix != ModeMix::one_energy)
    return {law.stiffness.value, fmt::format("the stiffness: {} has one for all modes", name_of(law.mix))};
  return {b2 * law.stiffness.value,
          fmt::format("(shear strength / strength)^2 = {:.4g} times the stiffness, by {}", b2, name_of(law.mix))};
}

std::vector<TractionPoint> whole_curve(std::span<const TractionPoint> states, bool is_complete, const ExportedLaw& law,
                                       double compliance) {
  const double K = law.stiffness.value, shift = 1.0 / K - compliance;
  std::vector<TractionPoint> curve{{0.0, 0.0}};
  double highest = 0.0;
  for (const auto [own, T] : states) {
    highest = std::max(highest, T);
    if (T <= 1e-6 * highest) {
      if (highest < law.strength.value) continue;
      break;
    }
    const double separation = std::max(std::max(0.0, own) + shift * T, T / K);
    if (separation > curve.back().separation) curve.push_back({separation, T});
  }
  const TractionPoint last = curve.back();
  double fall = least_drop * last.separation;
  if (!is_complete) fall = std::max(fall, 2.0 * (law.energy.value - area_under(curve)) / last.traction);
  curve.push_back({last.separation + fall, 0.0});
  return curve;
}

void add_tables(ExportedLaw& law, const std::vector<TractionPoint>& whole) {
  const double K = law.stiffness.value, strength = law.strength.value;
  law.curve = simplified(whole, table_tolerance * strength);
  law.damage = damage_table(law.curve, K, table_tolerance * strength);
  law.initiation = K * law.damage.front().separation;
  for (std::size_t i = 0; i + 1 < whole.size(); ++i)
    law.curve_error =
        std::max(law.curve_error, std::abs(traction_at(law.curve, whole[i].separation) - whole[i].traction) / strength);
  constexpr int samples = 8;  // of each interval
  for (std::size_t i = 1; i < law.damage.size(); ++i)
    for (int k = 0; k < samples; ++k) {
      const double from = law.damage[i - 1].separation, to = law.damage[i].separation;
      const double separation = from + (to - from) * k / samples;
      law.damage_error =
          std::max(law.damage_error,
                   std::abs(traction_at(law.damage, K, separation) - traction_at(law.curve, separation)) / strength);
    }
  law.damage_error += law.curve_error;
}

}  // namespace pfdm
