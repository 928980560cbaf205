#include "physics/damage/fatigue.h"

#include "physics/registry.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_toughness_factor = 1e-6;

constexpr FatigueLaw asymptotic{
    .name = "asymptotic",
    .description = "f = (2 alpha_T/(alpha + alpha_T))^2 beyond the threshold alpha_T (Carrara 2020)",
    .factor =
        [](double x, const LawParameters&) {
          const double root = 2.0 / (x + 1.0);
          return root * root;
        },
};

constexpr LawParameter logarithmic_parameters[] = {{"kappa", "1"}};
constexpr FatigueLaw logarithmic{
    .name = "logarithmic",
    .description = "f = (1 - kappa log10(alpha/alpha_T))^2 beyond the threshold alpha_T, in the end 0 (Carrara 2020)",
    .factor =
        [](double x, const LawParameters& p) {
          const double root = std::max(1.0 - p[0] * std::log10(x), 0.0);
          return root * root;
        },
    .parameters = logarithmic_parameters,
};

constexpr FatigueLaw all_fatigue_laws[] = {asymptotic, logarithmic};

}  // namespace

double Fatigue::factor(double energy) const {
  if (!is_chosen() || !(energy > threshold_)) return 1.0;
  return std::clamp(law_->factor(energy / threshold_, p_), least_toughness_factor, 1.0);
}

std::span<const FatigueLaw> fatigue_laws() { return all_fatigue_laws; }

const FatigueLaw& fatigue_law(std::string_view name) { return find_by_name(fatigue_laws(), name, "fatigue law"); }

}  // namespace pfdm
