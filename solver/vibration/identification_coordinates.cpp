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

}  // namespace pfdm
