#include "postproc/fits/uneven_scatter.h"

#include "solver/calibration/calibration_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Places in the order of the values, from 0.
ArrayXd ranks_of(const ArrayXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return values[i]; });
  ArrayXd ranks(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) ranks[order[k]] = static_cast<double>(k);
  return ranks;
}

/// That the ranks of two independent lists are correlated as much, by the normal limit.
double chance_of_order(const ArrayXd& squares, const ArrayXd& size) {
  const ArrayXd y = ranks_of(squares), x = ranks_of(size);
  const double n = static_cast<double>(y.size()), middle = 0.5 * (n - 1.0);
  const double correlation = ((x - middle) * (y - middle)).sum() * 12.0 / (n * (n * n - 1.0));
  return std::erfc(std::abs(correlation) * std::sqrt(0.5 * (n - 1.0)));
}

/// Of each estimate, the root of the sum of P_ji^2 e_i^2 over the sum of P_ji^2 times the mean of e_i^2.
std::vector<double> widening_of(const ArrayXd& squares, const MatrixXd& effects) {
  std::vector<double> widening;
  for (Eigen::Index j = 0; j < effects.cols(); ++j) {
    const ArrayXd weight = effects.col(j).head(squares.size()).array().square();
    const double even = weight.sum() * squares.mean();
    widening.push_back(even > 0.0 ? std::sqrt(std::max((weight * squares).sum() / even, 1.0)) : 1.0);
  }
  return widening;
}

}  // namespace

double UnevenScatter::widest() const { return widening.empty() ? 1.0 : std::ranges::max(widening); }

UnevenScatter uneven_scatter(const FitResult& result, const std::vector<double>& sizes) {
  const auto n = static_cast<Eigen::Index>(std::min(sizes.size(), result.residuals.size()));
  if (n < least_values || result.inverse_normal.size() == 0 || result.derivatives.rows() < n) return {};
  const MatrixXd effects = result.derivatives * result.inverse_normal;
  const ArrayXd squares = squares_of(result, effects, n);
  if (!(squares.sum() > 0.0) || !std::isfinite(squares.sum())) return {};
  const ArrayXd size = ArrayXd::Map(sizes.data(), n);
  const double median = quantile({size.begin(), size.end()}, 0.5);
  const ArrayXd is_large = (size >= median).cast<double>();
  const double n_large = is_large.sum(), n_small = static_cast<double>(n) - n_large;
  return {.probability = chance_of_order(squares, size),
          .median = median,
          .small = n_small > 0.0 ? std::sqrt((squares * (1.0 - is_large)).sum() / n_small) : 0.0,
          .large = std::sqrt((squares * is_large).sum() / n_large),
          .widening = widening_of(squares, effects),
          .freedom = static_cast<double>(result.derivatives.rows() - result.derivatives.cols())};
}

}  // namespace pfdm
