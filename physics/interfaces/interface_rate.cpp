#include "physics/interfaces/interface_rate.h"

#include <cmath>

namespace pfdm {
namespace {

constexpr double least = 1e-12;  // rate over the reference rate, below which a power m < 1 is straight

Overstress by_power(const LawParameters& p, double rate) {
  const double m = p[0], x = rate / p[1];
  if (m < 1.0 && x < least) {
    const double slope = std::pow(least, m - 1.0);
    return {slope * x, slope / p[1]};
  }
  const double r = std::pow(x, m);
  return {r, m * r / rate};
}

double rate_by_power(const LawParameters& p, double overstress) {
  const double m = p[0];
  const bool is_straight = m < 1.0 && overstress < std::pow(least, m);
  return p[1] * (is_straight ? overstress * std::pow(least, 1.0 - m) : std::pow(overstress, 1.0 / m));
}

Overstress by_logarithm(const LawParameters& p, double rate) {
  return {p[0] * std::log1p(rate / p[1]), p[0] / (p[1] + rate)};
}

double rate_by_logarithm(const LawParameters& p, double overstress) { return p[1] * std::expm1(overstress / p[0]); }

constexpr LawParameter power_of_opening[] = {{"m", "1"}, {"reference_rate", "m/s"}};
constexpr LawParameter logarithm_of_opening[] = {{"c", "1"}, {"reference_rate", "m/s"}};

constexpr InterfaceRateLaw rate_laws[] = {
    {"power", "T = T_0 (1 + (v/reference_rate)^m)", power_of_opening, by_power, rate_by_power},
    {"logarithmic", "T = T_0 (1 + c ln(1 + v/reference_rate))", logarithm_of_opening, by_logarithm, rate_by_logarithm},
};

}  // namespace

std::span<const InterfaceRateLaw> interface_rate_laws() { return rate_laws; }

}  // namespace pfdm
