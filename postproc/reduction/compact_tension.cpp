#include "postproc/reduction/beam_terms.h"
#include "postproc/reduction/test_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double shortest_compact_crack = 0.2, longest_compact_crack = 0.975;  // over W, of the compliance

/// f(a/W) of a compact specimen, ASTM E399 annex A4: within 0.5 % for 0.2 <= a/W < 1 (Srawley, Int. J. Fract. 12 (1976)
/// 475).
double compact_factor(double alpha) {
  return (2.0 + alpha) * (0.886 + alpha * (4.64 + alpha * (-13.32 + alpha * (14.72 - 5.6 * alpha)))) /
         std::pow(1.0 - alpha, 1.5);
}

/// E' B C of the load line, Saxena, Hudak (Int. J. Fract. 14 (1978) 453), also ASTM E1820: 0.2 <= a/W <= 0.975.
double compact_compliance(double alpha) {
  const double rest =
      2.1630 + alpha * (12.219 + alpha * (-20.065 + alpha * (-0.9925 + alpha * (20.609 - 9.9314 * alpha))));
  return square((1.0 + alpha) / (1.0 - alpha)) * rest;
}

/// a/W of a compliance E' B C, an end of the range where it is outside.
double compact_crack(double compliance) {
  return crack_of(compact_compliance, compliance, shortest_compact_crack, longest_compact_crack);
}

/// E' of the initial compliance [Pa].
double compact_modulus(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  return compact_compliance(s.crack_length / s.depth) / (s.width * data.straight.compliance);
}

/// "", or why the initial compliance gives no modulus.
std::string missing_for_compliance(const TestDimensions& s) {
  const double alpha = s.crack_length / s.depth;
  if (alpha >= shortest_compact_crack && alpha <= longest_compact_crack) return "";
  return fmt::format("needs a crack_length between {:g} and {:g} of depth for the compliance; it is {:.3g} of it",
                     shortest_compact_crack, longest_compact_crack, alpha);
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

/// K of a force and a crack length [Pa m^(1/2)].
auto compact_intensity(const TestDimensions& s) {
  return [b = s.width, W = s.depth](double P, double a) { return P / (b * std::sqrt(W)) * compact_factor(a / W); };
}

CalibratedMethod compact_stress_intensity(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const bool by_compliance = std::isnan(s.young_modulus);
  const std::string missing =
      by_compliance ? missing_for_compliance(s) : missing_dimensions({{"poisson_ratio", s.poisson_ratio}});
  if (!missing.empty()) return {.missing = missing};
  const double compliance =
      by_compliance ? 1.0 / compact_modulus(data) : (1.0 - square(s.poisson_ratio)) / s.young_modulus;
  const auto intensity = compact_intensity(s);
  return {.at =
              [=](double P, double, double a) {
                const double K = intensity(P, a);
                return Reduced{K * K * compliance, a};
              },
          .constants = {{"K_Q", "Pa m^(1/2)", intensity(data.five_percent.force, s.crack_length)},
                        {"greatest_over_Q", "1", data.straight.greatest_force / data.five_percent.force}},
          .remark = remark_on_factor(data)};
}

CalibratedMethod compact_equivalent_crack(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const std::string missing = missing_for_compliance(s);
  if (!missing.empty()) return {.missing = missing};
  const double modulus = compact_modulus(data), W = s.depth;
  const ReductionConstant constant =
      std::isnan(s.poisson_ratio) ? ReductionConstant{"E_plane_strain", "Pa", modulus}
                                  : ReductionConstant{"E_compliance", "Pa", (1.0 - square(s.poisson_ratio)) * modulus};
  return {.at =
              [=, b = s.width, intensity = compact_intensity(s)](double P, double d, double) {
                const double a = W * compact_crack(d / P * modulus * b);
                const bool is_inside = a > (1.0 + 1e-9) * shortest_compact_crack * W && a < longest_compact_crack * W;
                if (!is_inside) return Reduced{not_given, a};
                return Reduced{square(intensity(P, a)) / modulus, a};
              },
          .constants = {constant}};
}

constexpr ReductionMethod compact_methods[] = {
    {"stress_intensity",
     "ASTM E399 annex A4, D5045: K = P f(a/W)/(B W^(1/2)), f = (2 + a/W) (0.886 + 4.64 a/W - 13.32 (a/W)^2 + 14.72 "
     "(a/W)^3 - 5.6 (a/W)^4)/(1 - a/W)^(3/2); G = (1 - nu^2) K^2/E, E by the initial compliance where it is not given",
     true, compact_stress_intensity},
    {"equivalent_crack",
     "K of E399 at the crack that the compliance d/P of the load line tells, Saxena, Hudak, Int. J. Fract. 14 (1978) "
     "453; G = (1 - nu^2) K^2/E, E by the initial compliance",
     false, compact_equivalent_crack},
};

}  // namespace

std::span<const ReductionMethod> compact_tension_methods() { return compact_methods; }

}  // namespace pfdm
