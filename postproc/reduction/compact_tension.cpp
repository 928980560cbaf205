#include "postproc/reduction/test_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// f(a/W) of a compact specimen, ASTM E399 annex A4: within 0.5 % for 0.2 <= a/W < 1 (Srawley, Int. J. Fract. 12 (1976)
/// 475).
double compact_factor(double alpha) {
  return (2.0 + alpha) * (0.886 + alpha * (4.64 + alpha * (-13.32 + alpha * (14.72 - 5.6 * alpha)))) /
         std::pow(1.0 - alpha, 1.5);
}

/// "", or which cracks are too short for f.
std::string remark_on_factor(const CalibrationData& data) {
  constexpr double least = 0.2;
  double shortest = data.specimen.crack_length, longest = shortest;
  for (const std::size_t i : data.grown) {
    shortest = std::min(shortest, data.record.crack_length[i]);
    longest = std::max(longest, data.record.crack_length[i]);
  }
  const double low = shortest / data.specimen.depth, high = longest / data.specimen.depth;
  if (low >= least && high < 1.0) return "";
  return fmt::format("a/W = {:.3g}: the factor of stress_intensity holds from 0.2 to below 1",
                     low < least ? low : high);
}

CalibratedMethod compact_stress_intensity(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const std::string missing =
      missing_dimensions({{"young_modulus", s.young_modulus}, {"poisson_ratio", s.poisson_ratio}});
  if (!missing.empty()) return {.missing = missing};
  const double compliance = (1.0 - s.poisson_ratio * s.poisson_ratio) / s.young_modulus;
  const auto intensity = [b = s.width, W = s.depth](double P, double a) {
    return P / (b * std::sqrt(W)) * compact_factor(a / W);
  };
  return {.at =
              [=](double P, double, double a) {
                const double K = intensity(P, a);
                return Reduced{K * K * compliance, a};
              },
          .constants = {{"K_Q", "Pa m^(1/2)", intensity(data.five_percent.force, s.crack_length)},
                        {"greatest_over_Q", "1", data.straight.greatest_force / data.five_percent.force}},
          .remark = remark_on_factor(data)};
}

constexpr ReductionMethod compact_methods[] = {
    {"stress_intensity",
     "ASTM E399 annex A4, D5045: K = P f(a/W)/(B W^(1/2)), f = (2 + a/W) (0.886 + 4.64 a/W - 13.32 (a/W)^2 + 14.72 "
     "(a/W)^3 - 5.6 (a/W)^4)/(1 - a/W)^(3/2); G = (1 - nu^2) K^2/E",
     true, compact_stress_intensity},
};

}  // namespace

std::span<const ReductionMethod> compact_tension_methods() { return compact_methods; }

}  // namespace pfdm
