#include "physics/damage/softening_law.h"

#include "physics/registry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

constexpr SofteningLaw linear{
    .name = "linear",
    .description = "sigma = ft (1 - w/wc), wc = 2 Gf/ft; produced exactly",
    .initial_slope = 0.5,
    .final_opening = 2.0,
    .exponent = 2.0,
    .traction = [](double w) { return std::max(0.0, 1.0 - 0.5 * w); },
    .slope = [](double w) { return w < 2.0 ? -0.5 : 0.0; },
    .work = [](double w) { return w < 2.0 ? w - 0.25 * w * w : 1.0; },
};

constexpr SofteningLaw exponential{
    .name = "exponential",
    .description = "sigma = ft exp(-ft w/Gf)",
    .initial_slope = 1.0,
    .final_opening = no_end,
    .exponent = 2.5,
    .traction = [](double w) { return std::exp(-w); },
    .slope = [](double w) { return -std::exp(-w); },
    .work = [](double w) { return -std::expm1(-w); },
};

constexpr SofteningLaw hyperbolic{
    .name = "hyperbolic",
    .description = "sigma = ft (1 + ft w/Gf)^-2",
    .initial_slope = 2.0,
    .final_opening = no_end,
    .exponent = 4.0,
    .traction = [](double w) { return 1.0 / ((1.0 + w) * (1.0 + w)); },
    .slope = [](double w) { return -2.0 / ((1.0 + w) * (1.0 + w) * (1.0 + w)); },
    .work = [](double w) { return w / (1.0 + w); },
};

// Cornelissen, Hordijk, Reinhardt, Heron 31 (1986) 45, with eta1 = 3, eta2 = 6.93: area Gf for wc = 5.1361 Gf/ft.
constexpr double eta2 = 6.93, cornelissen_end = 5.1361;
constexpr SofteningLaw cornelissen{
    .name = "cornelissen",
    .description = "concrete: sigma = ft ((1 + 27 r^3) exp(-6.93 r) - 28 r exp(-6.93)), r = w/wc, wc = 5.1361 Gf/ft",
    .initial_slope = 1.3546,
    .final_opening = cornelissen_end,
    .exponent = 2.0,
    .traction =
        [](double w) {
          const double r = std::min(w / cornelissen_end, 1.0);
          const double t = (1.0 + 27.0 * r * r * r) * std::exp(-eta2 * r) - 28.0 * r * std::exp(-eta2);
          return std::max(t, 0.0);  // rounding, at wc
        },
    .slope =
        [](double w) {
          const double r = w / cornelissen_end, e = std::exp(-eta2 * r);
          if (r >= 1.0) return 0.0;
          return (81.0 * r * r * e - eta2 * (1.0 + 27.0 * r * r * r) * e - 28.0 * std::exp(-eta2)) / cornelissen_end;
        },
    .work =
        [](double w) {
          const double r = std::min(w / cornelissen_end, 1.0), x = eta2 * r, e = std::exp(-x);
          const double third_moment =
              (6.0 - e * (x * x * x + 3.0 * x * x + 6.0 * x + 6.0)) / (eta2 * eta2 * eta2 * eta2);
          return cornelissen_end * ((1.0 - e) / eta2 + 27.0 * third_moment - 14.0 * r * r * std::exp(-eta2));
        },
};

constexpr SofteningLaw all_softening_laws[] = {linear, exponential, hyperbolic, cornelissen};

double second_coefficient(const SofteningLaw& law) {
  return 2.0 * std::pow(2.0 * law.initial_slope, 2.0 / 3.0) - law.exponent - 0.5;
}

}  // namespace

std::span<const SofteningLaw> softening_laws() { return all_softening_laws; }

const SofteningLaw& softening_law(std::string_view name) {
  return find_by_name(softening_laws(), name, "softening law");
}

RationalCoefficients rational_coefficients(const SofteningLaw& law, double E, double Gf, double ft, double ell) {
  RationalCoefficients c;
  c.p = law.exponent;
  c.a1 = 4.0 * E * Gf / (std::numbers::pi * ell * ft * ft);
  c.a2 = second_coefficient(law);
  if (std::isfinite(law.final_opening)) c.a3 = (0.125 * law.final_opening * law.final_opening - 1.0 - c.a2) / c.a2;
  return c;
}

double longest_length(const SofteningLaw& law, double E, double Gf, double ft) {
  return 4.0 * E * Gf / (std::numbers::pi * ft * ft * (second_coefficient(law) + law.exponent + 0.5));
}

}  // namespace pfdm
