#include "postproc/fits/uneven_scatter.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

constexpr Eigen::Index least_values = 16;

/// Squares of the residuals over what the fit leaves of each one's variance, 1 - h_ii.
ArrayXd squares_of(const FitResult& result, const MatrixXd& effects, Eigen::Index n) {
  ArrayXd squares(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double residual = result.residuals[static_cast<std::size_t>(i)];
    const double leverage = result.derivatives.row(i).dot(effects.row(i));
    squares[i] = residual * residual / std::max(1.0 - leverage, 1e-3);
  }
  return squares;
}

/// P(chi^2 of one degree of freedom > n R^2) of the line of the squares over the size.
double chance_of_line(const ArrayXd& squares, const ArrayXd& size) {
  const ArrayXd y = squares - squares.mean(), x = size - size.mean();
  const double both = (x * y).sum(), all = x.square().sum() * y.square().sum();
  if (!(all > 0.0)) return 1.0;
  return std::erfc(std::sqrt(0.5 * static_cast<double>(squares.size()) * both * both / all));
}

/// Largest of the estimates, sum of P_ji^2 e_i^2 over sum of P_ji^2 times the mean of e_i^2.
double widening_of(const ArrayXd& squares, const MatrixXd& effects) {
  double most = 1.0;
  for (Eigen::Index j = 0; j < effects.cols(); ++j) {
    const ArrayXd weight = effects.col(j).head(squares.size()).array().square();
    if (weight.sum() > 0.0) most = std::max(most, (weight * squares).sum() / (weight.sum() * squares.mean()));
  }
  return std::sqrt(most);
}

}  // namespace

UnevenScatter uneven_scatter(const FitResult& result, const std::vector<double>& measured) {
  const auto n = static_cast<Eigen::Index>(std::min(measured.size(), result.residuals.size()));
  if (n < least_values || result.inverse_normal.size() == 0 || result.derivatives.rows() < n) return {};
  const MatrixXd effects = result.derivatives * result.inverse_normal;
  const ArrayXd squares = squares_of(result, effects, n);
  if (!(squares.sum() > 0.0) || !std::isfinite(squares.sum())) return {};
  const ArrayXd size = ArrayXd::Map(measured.data(), n).abs();
  std::vector<double> sorted(size.begin(), size.end());
  std::ranges::nth_element(sorted, sorted.begin() + n / 2);
  const ArrayXd is_large = (size >= sorted[static_cast<std::size_t>(n / 2)]).cast<double>();
  const double n_large = is_large.sum(), n_small = static_cast<double>(n) - n_large;
  return {.probability = chance_of_line(squares, size),
          .small = n_small > 0.0 ? std::sqrt((squares * (1.0 - is_large)).sum() / n_small) : 0.0,
          .large = std::sqrt((squares * is_large).sum() / n_large),
          .widening = widening_of(squares, effects)};
}

}  // namespace pfdm
