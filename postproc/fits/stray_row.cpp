#include "postproc/fits/stray_row.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace pfdm {
namespace {

using Eigen::VectorXd;

constexpr std::size_t fewest_rows = 8;
constexpr double negligible = 1e-8;  // of the sum of squares

/// Whether the i-th value stands out from the lines through two neighbours on either side, to the same side, by more
/// than `least`.
bool stands_out(std::span<const double> values, std::size_t i, double least) {
  if (i < 2 || i + 2 >= values.size()) return false;
  const double before = values[i] - 2.0 * values[i - 1] + values[i - 2],
               after = values[i] - 2.0 * values[i + 1] + values[i + 2];
  return before * after > 0.0 && std::min(std::abs(before), std::abs(after)) > least;
}

double chance_beyond(double distance, double freedom, bool noise_is_known) {
  if (noise_is_known) return std::erfc(distance / std::sqrt(2.0));
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), distance));
}

}  // namespace

std::optional<StrayRow> stray_row(const FitResult& result, const std::vector<double>& measured) {
  const auto n = static_cast<Eigen::Index>(result.residuals.size());
  const std::size_t n_rows = std::min(measured.size(), result.residuals.size());
  const double freedom = static_cast<double>(n - result.derivatives.cols() - 1);
  const bool is_known = result.derivatives.rows() == n && result.inverse_normal.size() > 0;
  if (n_rows < fewest_rows || !is_known || !(freedom >= 1.0)) return std::nullopt;
  std::optional<StrayRow> worst;
  for (std::size_t i = 0; i < n_rows; ++i) {
    const double e = result.residuals[i];
    if (!stands_out(measured, i, 0.5 * std::abs(e))) continue;
    const VectorXd effect = result.inverse_normal * result.derivatives.row(static_cast<Eigen::Index>(i)).transpose();
    const double leverage = result.derivatives.row(static_cast<Eigen::Index>(i)).dot(effect);
    const double left = std::max(1.0 - leverage, 1e-6);
    const double all = result.sum_of_squares, others = std::max(all - e * e / left, negligible * all) / freedom;
    const double sigma = result.noise_is_known ? 1.0 : std::sqrt(others);
    const double distance = std::abs(e) / (sigma * std::sqrt(left));
    if (worst && distance <= worst->distance) continue;
    const double chance = static_cast<double>(n_rows) * chance_beyond(distance, freedom, result.noise_is_known);
    // What the row adds to the estimates, (J^T J)^-1 J_i e_i/(1 - h_i).
    const VectorXd errors = (sigma * result.inverse_normal.diagonal().cwiseSqrt()).cwiseMax(1e-300);
    const double shift = (effect * e / left).cwiseQuotient(errors).cwiseAbs().maxCoeff();
    worst = StrayRow{.row = i, .distance = distance, .probability = std::min(chance, 1.0), .shift = shift};
  }
  return worst;
}

}  // namespace pfdm
