#include "postproc/fits/stray_row.h"

#include "postproc/fits/uneven_scatter.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace pfdm {
namespace {

using Eigen::VectorXd;

constexpr std::size_t fewest_rows = 8;
constexpr double negligible = 1e-8;     // of the sum of squares
constexpr double most_leverage = 0.99;  // beyond, a row determines a combination of parameters alone

/// The values of the record that the i-th of all belongs to, and its place among them.
struct Place {
  std::span<const double> record;
  std::size_t i = 0;
};

std::vector<Place> places_in(const std::vector<std::vector<double>>& records, std::size_t n) {
  std::vector<Place> places;
  for (const std::vector<double>& record : records)
    for (std::size_t i = 0; i < record.size() && places.size() < n; ++i) places.push_back({record, i});
  return places;
}

/// Whether a value stands out from the lines through two neighbours on either side, to the same side, by more than
/// `least`.
bool stands_out(const Place& place, double least) {
  const auto& [values, i] = place;
  if (i < 2 || i + 2 >= values.size()) return false;
  const double before = values[i] - 2.0 * values[i - 1] + values[i - 2],
               after = values[i] - 2.0 * values[i + 1] + values[i + 2];
  return before * after > 0.0 && std::min(std::abs(before), std::abs(after)) > least;
}

double chance_beyond(double distance, double freedom, bool noise_is_known) {
  if (noise_is_known) return std::erfc(distance / std::sqrt(2.0));
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), distance));
}

FitResult without_row(FitResult result, std::size_t row) {
  const auto i = static_cast<Eigen::Index>(row), behind = result.derivatives.rows() - i - 1;
  result.residuals.erase(result.residuals.begin() + i);
  result.derivatives.middleRows(i, behind) = result.derivatives.bottomRows(behind).eval();
  result.derivatives.conservativeResize(i + behind, Eigen::NoChange);
  return result;
}

/// Scatter of all other rows over that of those of like size as the row; 1 where it does not follow their size.
double over_like_rows(const FitResult& result, std::size_t row, std::vector<double> sizes) {
  constexpr double false_alarm = 0.002;
  if (row >= sizes.size()) return 1.0;
  const double size = sizes[row];
  sizes.erase(sizes.begin() + static_cast<std::ptrdiff_t>(row));
  const UnevenScatter scatter = uneven_scatter(without_row(result, row), sizes);
  if (!(scatter.probability < false_alarm)) return 1.0;
  return std::hypot(scatter.small, scatter.large) / std::sqrt(2.0) /
         (size >= scatter.median ? scatter.large : scatter.small);
}

}  // namespace

std::optional<StrayRow> stray_row(const FitResult& result, const std::vector<std::vector<double>>& records,
                                  const std::vector<double>& sizes) {
  const auto n = static_cast<Eigen::Index>(result.residuals.size());
  const std::vector<Place> places = places_in(records, result.residuals.size());
  const std::size_t n_rows = places.size();
  const double freedom = static_cast<double>(n - result.derivatives.cols() - 1);
  const bool is_known = result.derivatives.rows() == n && result.inverse_normal.size() > 0;
  if (n_rows < fewest_rows || !is_known || !(freedom >= 1.0)) return std::nullopt;
  std::optional<StrayRow> worst;
  for (std::size_t i = 0; i < n_rows; ++i) {
    const double e = result.residuals[i];
    if (!stands_out(places[i], 0.5 * std::abs(e))) continue;
    const VectorXd effect = result.inverse_normal * result.derivatives.row(static_cast<Eigen::Index>(i)).transpose();
    const double leverage = result.derivatives.row(static_cast<Eigen::Index>(i)).dot(effect);
    if (!(leverage < most_leverage)) continue;
    const double left = 1.0 - leverage;
    const double all = result.sum_of_squares, others = std::max(all - e * e / left, negligible * all) / freedom;
    const double sigma = result.noise_is_known ? std::max(std::sqrt(others), 1.0) : std::sqrt(others);
    const double distance = std::abs(e) / (sigma * std::sqrt(left));
    if (worst && distance <= worst->distance) continue;
    const double chance = static_cast<double>(n_rows) * chance_beyond(distance, freedom, result.noise_is_known);
    // What the row adds to the estimates, (J^T J)^-1 J_i e_i/(1 - h_i).
    const VectorXd errors = (sigma * result.inverse_normal.diagonal().cwiseSqrt()).cwiseMax(1e-300);
    const double shift = (effect * e / left).cwiseQuotient(errors).cwiseAbs().maxCoeff();
    worst = StrayRow{.row = i, .distance = distance, .probability = std::min(chance, 1.0), .shift = shift};
  }
  if (worst && !result.noise_is_known) {
    worst->distance *= over_like_rows(result, worst->row, sizes);
    const double chance = static_cast<double>(n_rows) * chance_beyond(worst->distance, freedom, false);
    worst->probability = std::min(chance, 1.0);
  }
  return worst;
}

}  // namespace pfdm
