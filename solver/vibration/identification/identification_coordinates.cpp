#include "solver/vibration/identification/identification_coordinates.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace pfdm {
namespace {
using Eigen::VectorXd;

constexpr double most_exponent = 4.0;
constexpr double pair_scale = 0.1;  // of a pair's beta, over that of the stiffness k_1
constexpr double unnoticed = 1e-5;  // part of the stiffness, or of the critical damping

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
    if (term.is_pair()) {
      const std::complex<double> beta = term.beta / beta_like_stiffness(terms_, std::abs(term.alpha));
      x.insert(x.end(), {beta.real() / pair_scale, beta.imag() / pair_scale, std::log(term.alpha.real()),
                         inverse_sigmoid((std::log(term.alpha.imag()) - log_low_) / (log_high_ - log_low_))});
      continue;
    }
    x.push_back(std::log(std::abs(term.beta.real())));
    x.push_back(inverse_sigmoid((std::log(term.alpha.real()) - log_low_) / (log_high_ - log_low_)));
  }
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

MassMaterial ParameterCoordinates::model(const VectorXd& x) const {
  MassMaterial m = terms_;
  Eigen::Index at = 0;
  m.stiffness[0] = std::exp(x[at++]);
  for (std::size_t i = 1; i < m.stiffness.size(); ++i)
    m.stiffness[i] = x[at++] * m.stiffness[0] / std::pow(displacement_, i);
  m.damping = std::exp(x[at++]);
  if (free_exponent()) m.damping_exponent = most_exponent * sigmoid(x[at++]);
  const double sign = dissipative_sign(m.forcing);
  for (HereditaryTerm& term : m.kernel) {
    if (term.is_pair()) {
      const std::complex<double> beta(x[at], x[at + 1]);
      term.alpha = {std::exp(x[at + 2]), std::exp(log_low_ + (log_high_ - log_low_) * sigmoid(x[at + 3]))};
      term.beta = pair_scale * beta_like_stiffness(terms_, std::abs(term.alpha)) * beta;
      at += 4;
      continue;
    }
    term.beta = sign * std::exp(x[at++]);
    term.alpha = std::exp(log_low_ + (log_high_ - log_low_) * sigmoid(x[at++]));
  }
  return m;
}

/// Of a term's beta that has the same effect as the stiffness k_1 at the rate alpha.
double ParameterCoordinates::beta_like_stiffness(const MassMaterial& m, double alpha) {
  if (m.forcing == KernelForcing::displacement) return m.stiffness[0] * alpha;
  return m.forcing == KernelForcing::stiffness ? alpha : m.stiffness[0];
}

std::vector<std::pair<double, double>> ParameterCoordinates::bounds(const MassMaterial& m) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, double>> result(m.stiffness.size(), {-infinite, infinite});
  result.emplace_back(std::log(0.1 * unnoticed * std::sqrt(m.stiffness[0] * m.mass)), infinite);
  if (free_exponent()) result.emplace_back(-infinite, infinite);
  for (const HereditaryTerm& term : m.kernel) {
    if (term.is_pair()) {
      result.insert(result.end(), 4, {-infinite, infinite});
      continue;
    }
    result.emplace_back(std::log(0.1 * unnoticed * beta_like_stiffness(m, term.alpha.real())), infinite);
    result.emplace_back(-infinite, infinite);
  }
  return result;
}

void ParameterCoordinates::set_bounds(const MassMaterial& m, std::vector<Estimate>& values) const {
  constexpr double near = 0.01;  // of the range of a sigmoid
  std::size_t at = m.stiffness.size();
  const auto positive = [&](double size, bool turned) {
    Estimate& e = values[at++];
    (turned ? e.upper_bound : e.lower_bound) = 0.0;
    e.at_bound = std::abs(e.value) < unnoticed * size;
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
    if (term.is_pair()) {
      at += 4;
      continue;
    }
    between(std::exp(log_low_), std::exp(log_high_), (std::log(alpha) - log_low_) / (log_high_ - log_low_));
    positive(beta_like_stiffness(m, alpha), dissipative_sign(m.forcing) < 0.0);
  }
}

void sort_terms(MassMaterial& m) {
  std::ranges::sort(m.kernel, {}, [](const HereditaryTerm& term) { return term.alpha.real(); });
}

std::optional<std::vector<Eigen::Index>> rising_order(const MassMaterial& m, Eigen::Index n_coordinates) {
  std::vector<Eigen::Index> first;  // of each term
  Eigen::Index n_terms = 0;
  for (const HereditaryTerm& term : m.kernel) {
    first.push_back(n_terms);
    n_terms += term.is_pair() ? 4 : 2;
  }
  std::vector<std::size_t> terms(m.kernel.size());
  std::iota(terms.begin(), terms.end(), std::size_t{0});
  std::ranges::stable_sort(terms, {}, [&](std::size_t i) { return m.kernel[i].alpha.real(); });
  if (std::ranges::is_sorted(terms)) return std::nullopt;
  std::vector<Eigen::Index> columns(n_coordinates - n_terms);
  std::iota(columns.begin(), columns.end(), Eigen::Index{0});
  for (const std::size_t i : terms)
    for (Eigen::Index k = 0; k < (m.kernel[i].is_pair() ? 4 : 2); ++k)
      columns.push_back(n_coordinates - n_terms + first[i] + k);
  return columns;
}

}  // namespace pfdm
