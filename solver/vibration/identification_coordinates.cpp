#include "solver/vibration/identification_coordinates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfdm {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double most_exponent = 4.0;

double sigmoid(double x) { return 1.0 / (1.0 + std::exp(-x)); }

double inverse_sigmoid(double y) {
  const double inside = std::clamp(y, 1e-3, 1.0 - 1e-3);
  return std::log(inside / (1.0 - inside));
}

}  // namespace

ParameterCoordinates::ParameterCoordinates(const MassMaterial& terms, const ExcitedRange& range)
    : terms_(terms),
      displacement_(range.displacement),
      log_low_(std::log(2.0 * std::numbers::pi * range.low / 10.0)),
      log_high_(std::log(2.0 * std::numbers::pi * range.high * 10.0)) {}

VectorXd ParameterCoordinates::from(const MassMaterial& m) const {
  std::vector<double> x{std::log(m.stiffness[0])};
  for (std::size_t i = 1; i < m.stiffness.size(); ++i)
    x.push_back(m.stiffness[i] * std::pow(displacement_, i) / m.stiffness[0]);
  x.push_back(std::log(std::max(m.damping, 1e-4 * std::sqrt(m.stiffness[0] * m.mass))));
  if (free_exponent()) x.push_back(inverse_sigmoid(m.damping_exponent / most_exponent));
  for (const HereditaryTerm& term : m.kernel) {
    x.push_back(std::log(std::abs(term.beta.real())));
    x.push_back(inverse_sigmoid((std::log(term.alpha.real()) - log_low_) / (log_high_ - log_low_)));
  }
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
}

MassMaterial ParameterCoordinates::model(const VectorXd& x) const {
  MassMaterial m = terms_;
  Index at = 0;
  m.stiffness[0] = std::exp(x[at++]);
  for (std::size_t i = 1; i < m.stiffness.size(); ++i)
    m.stiffness[i] = x[at++] * m.stiffness[0] / std::pow(displacement_, i);
  m.damping = std::exp(x[at++]);
  if (free_exponent()) m.damping_exponent = most_exponent * sigmoid(x[at++]);
  const double sign = dissipative_sign(m.forcing);
  for (HereditaryTerm& term : m.kernel) {
    term.beta = sign * std::exp(x[at++]);
    term.alpha = std::exp(log_low_ + (log_high_ - log_low_) * sigmoid(x[at++]));
  }
  return m;
}

void ParameterCoordinates::set_bounds(const MassMaterial& m, std::vector<Estimate>& values) const {
  constexpr double near = 0.01;  // of the range of a sigmoid
  constexpr double gone = 1e-5;  // of what would be noticed
  std::size_t at = m.stiffness.size();
  const auto positive = [&](double size, bool turned) {
    Estimate& e = values[at++];
    (turned ? e.upper_bound : e.lower_bound) = 0.0;
    e.at_bound = std::abs(e.value) < gone * size;
  };
  const auto between = [&](double lower, double upper, double part) {
    Estimate& e = values[at++];
    e.lower_bound = lower;
    e.upper_bound = upper;
    e.at_bound = part < near || part > 1.0 - near;
  };
  positive(std::sqrt(m.stiffness[0] * m.mass), false);
  if (free_exponent()) between(0.0, most_exponent, m.damping_exponent / most_exponent);
  for (const HereditaryTerm& term : m.kernel) {
    const double alpha = term.alpha.real();
    between(std::exp(log_low_), std::exp(log_high_), (std::log(alpha) - log_low_) / (log_high_ - log_low_));
    const double size = m.forcing == KernelForcing::displacement ? m.stiffness[0] * alpha
                        : m.forcing == KernelForcing::stiffness  ? alpha
                                                                 : m.stiffness[0];
    positive(size, dissipative_sign(m.forcing) < 0.0);
  }
}

}  // namespace pfdm
