#include "solver/calibration/correlated_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr Eigen::Index most_lags = 100;
constexpr double most_correlated = 0.99;

struct SeriesRows {
  Eigen::Index begin, n;
  Eigen::Index lags() const { return std::min(n / 8, most_lags); }
};

/// Sum over the pairs `lag` apart of the products of rows.
double lagged(const MatrixXd& X, const MatrixXd& Y, const SeriesRows& span, Eigen::Index lag) {
  const Eigen::Index n = span.n - lag;
  return X.middleRows(span.begin, n).cwiseProduct(Y.middleRows(span.begin + lag, n)).sum();
}

/// R X with R_ij = rho^|i - j| within each series, by a pass forwards and one backwards.
MatrixXd correlate(const MatrixXd& X, const std::vector<SeriesRows>& spans, double rho) {
  MatrixXd result = -X;
  for (const SeriesRows& span : spans) {
    RowVectorXd ahead = RowVectorXd::Zero(X.cols()), behind = ahead;
    for (Eigen::Index i = 0; i < span.n; ++i) {
      const Eigen::Index first = span.begin + i, last = span.begin + span.n - 1 - i;
      ahead = X.row(first) + rho * ahead;
      behind = X.row(last) + rho * behind;
      result.row(first) += ahead;
      result.row(last) += behind;
    }
  }
  return result;
}

/// How the fit turns noise into errors P e of the estimates and residuals M e, M = 1 - J P.
struct LinearFit {
  const MatrixXd& J;              // (n, p)
  MatrixXd effects;               // P^T (n, p)
  std::vector<SeriesRows> spans;  // series
};

/// What is expected of noise e with e_i e_j = rho^|i - j|.
class ExpectedNoise {
 public:
  ExpectedNoise(const LinearFit& fit, double rho) : fit_(fit), rho_(rho) {
    through_ = correlate(fit.effects, fit.spans, rho);  // R P^T
    covariance_ = fit.effects.transpose() * through_;   // P R P^T
    beside_ = fit.J * covariance_;
  }
  /// Sum of the products of residuals `lag` apart, of a series: trace of S M R M, S the mean of both shifts.
  double product(const SeriesRows& span, Eigen::Index lag) const {
    const double of_noise = static_cast<double>(span.n - lag) * std::pow(rho_, static_cast<double>(lag));
    return of_noise - lagged(fit_.J, through_, span, lag) - lagged(through_, fit_.J, span, lag) +
           lagged(fit_.J, beside_, span, lag);
  }
  double variance(Eigen::Index j) const { return covariance_(j, j); }  ///< of the error of estimate j

 private:
  const LinearFit& fit_;
  double rho_;
  MatrixXd through_, covariance_, beside_;
};

/// Correlation of neighbours in the residuals, of white noise or of the residuals themselves.
template <class Product>
double neighbours(const std::vector<SeriesRows>& spans, const Product& product) {
  double next = 0.0, own = 0.0;
  for (const SeriesRows& span : spans) {
    if (span.n < 2) continue;
    next += product(span, 1);
    own += product(span, 0);
  }
  return own > 0.0 ? next / own : 0.0;
}

/// The correlation of the noise whose residuals are as correlated as those found.
double correlation_of_noise(const LinearFit& fit, const VectorXd& residuals) {
  const double found = neighbours(
      fit.spans, [&](const SeriesRows& s, Eigen::Index lag) { return lagged(residuals, residuals, s, lag); });
  double low = 0.0, high = most_correlated;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    const ExpectedNoise noise(fit, middle);
    const double expected =
        neighbours(fit.spans, [&](const SeriesRows& s, Eigen::Index lag) { return noise.product(s, lag); });
    (expected < found ? low : high) = middle;
  }
  return low < 1e-3 ? 0.0 : 0.5 * (low + high);
}

/// Weights of the autocovariances of a series in the variance of an estimate.
VectorXd window(const SeriesRows& span, const VectorXd& effects) {
  VectorXd weights(span.lags() + 1);
  for (Eigen::Index k = 0; k < weights.size(); ++k)
    weights[k] = (1.0 - static_cast<double>(k) / static_cast<double>(span.lags() + 1)) * (k == 0 ? 1.0 : 2.0) *
                 lagged(effects, effects, span, k) / static_cast<double>(span.n);
  return weights;
}

/// Integrals over the frequencies of window times spectrum and of its square.
std::pair<double, double> spectral_means(const VectorXd& weights, double rho) {
  const Eigen::Index n = 8 * weights.size();
  double mean = 0.0, square = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double omega = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    double filter = 0.0;
    for (Eigen::Index k = 0; k < weights.size(); ++k) filter += weights[k] * std::cos(omega * static_cast<double>(k));
    filter *= (1.0 - rho * rho) / (1.0 - 2.0 * rho * std::cos(omega) + rho * rho);
    mean += filter / static_cast<double>(n);
    square += filter * filter / static_cast<double>(n);
  }
  return {mean, square};
}

CorrelatedError error_of(const LinearFit& fit, const ExpectedNoise& noise, double rho, const VectorXd& residuals,
                         Eigen::Index j, double white_variance) {
  double found = 0.0, expected = 0.0, trace = 0.0, squares = 0.0;
  const VectorXd effects = fit.effects.col(j);
  for (const SeriesRows& span : fit.spans) {
    const VectorXd weights = window(span, effects);
    for (Eigen::Index k = 0; k < weights.size(); ++k) {
      found += weights[k] * lagged(residuals, residuals, span, k);
      expected += weights[k] * noise.product(span, k);
    }
    const auto [mean, square] = spectral_means(weights, rho);
    trace += static_cast<double>(span.n) * mean;
    squares += static_cast<double>(span.n) * square;
  }
  const double variance = noise.variance(j);
  if (!(variance > 0.0) || !(white_variance > 0.0)) return {};
  const double visible = expected / variance;
  const double widening = visible > 0.0 ? std::sqrt(std::max(found / visible / white_variance, 1.0)) : 1.0;
  return {.widening = widening, .freedom = std::max(trace * trace / squares, 1.0), .visible = visible};
}

}  // namespace

std::vector<CorrelatedError> correlated_errors(const FitResult& result, const std::vector<std::size_t>& series) {
  LinearFit fit{.J = result.derivatives, .effects = result.derivatives * result.inverse_normal, .spans = {}};
  Eigen::Index begin = 0;
  for (const std::size_t n : series) {
    fit.spans.push_back({begin, static_cast<Eigen::Index>(n)});
    begin += static_cast<Eigen::Index>(n);
  }
  const VectorXd residuals = VectorXd::Map(result.residuals.data(), std::ssize(result.residuals));
  const double rho = correlation_of_noise(fit, residuals);
  const ExpectedNoise noise(fit, rho);
  std::vector<CorrelatedError> errors;
  for (Eigen::Index j = 0; j < fit.J.cols(); ++j)
    errors.push_back(std::isfinite(result.covariance(j, j))
                         ? error_of(fit, noise, rho, residuals, j, result.covariance(j, j))
                         : CorrelatedError{});
  return errors;
}

}  // namespace pfdm
