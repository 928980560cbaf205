#include "physics/traction_separation.h"

#include "physics/softening_law.h"

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Shape = std::span<const double>;
using Law = TractionSeparationLaw;

/// What lies beyond a straight rise that takes a share of the energy.
struct Softening {
  double start;   // separation at the strength [m]
  double energy;  // that is left [J/m^2]
};

Softening beyond_rise(double strength, double energy, double share) {
  return {2.0 * share * energy / strength, (1.0 - share) * energy};
}

double with_softening(const Law& law, double separation, double strength, double energy, Shape shape) {
  const auto [start, rest] = beyond_rise(strength, energy, shape[0]);
  if (separation <= 0.0) return 0.0;
  if (separation < start) return strength * separation / start;
  return strength * softening_law(law.name).traction((separation - start) * strength / rest);
}

double bilinear(const Law&, double separation, double strength, double energy, Shape shape) {
  const auto [start, rest] = beyond_rise(strength, energy, shape[0]);
  if (separation <= 0.0) return 0.0;
  if (separation < start) return strength * separation / start;
  const double kink = shape[1] * strength, opening = separation - start;
  const double to_kink = 2.0 * shape[2] * rest / (strength + kink), to_end = 2.0 * (1.0 - shape[2]) * rest / kink;
  if (opening < to_kink) return strength + (kink - strength) * opening / to_kink;
  return kink * std::max(0.0, 1.0 - (opening - to_kink) / to_end);
}

double xu_needleman(const Law&, double separation, double strength, double energy, Shape) {
  const double x = separation * strength * std::numbers::e / energy;
  return x > 0.0 ? strength * x * std::exp(1.0 - x) : 0.0;
}

double ppr(const Law&, double separation, double strength, double energy, Shape shape) {
  const double a = shape[0], L = shape[1] / std::sqrt(a), m = a * (a - 1.0) * L * L / (1.0 - a * L * L);
  const auto form = [&](double x) {
    return (m + a) * x * std::pow(1.0 - x, a - 1.0) * std::pow(m / a + x, m - 1.0) * std::pow(a / m, m);
  };
  const double final_separation = energy * form(L) / strength, x = separation / final_separation;
  return x > 0.0 && x < 1.0 ? energy / final_separation * form(x) : 0.0;
}

constexpr ShapeParameter rise{"rise_share_of_energy", 0.02, 1e-6, 0.95};

std::vector<Law> make_table() {
  std::vector<Law> table;
  for (const SofteningLaw& law : softening_laws()) table.push_back({law.name, law.description, {rise}, with_softening});
  table.push_back({"bilinear",
                   "two straight lines, a kink between them",
                   {rise, {"kink_over_strength", 0.3, 0.02, 0.98}, {"share_before_kink", 0.5, 0.02, 0.98}},
                   bilinear});
  table.push_back(
      {"xu_needleman", "sigma_c (delta/delta_0) exp(1 - delta/delta_0), Gc = e sigma_c delta_0", {}, xu_needleman});
  table.push_back({"ppr",
                   "Park, Paulino, Roesler's potential in mode I",
                   {{"alpha", 3.0, 1.05, 50.0}, {"peak_over_limit", 0.3, 0.005, 0.99}},
                   ppr});
  return table;
}

}  // namespace

std::span<const TractionSeparationLaw> traction_separation_laws() {
  static const std::vector<Law> table = make_table();
  return table;
}

}  // namespace pfdm
