#include "solver/point/allowed_spectra.h"

#include "solver/linear/dense_algebra.h"
#include "solver/point/viscoelastic_start.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr int per_decade = 8;                              // of the grid of times
constexpr double least_amount = 1e-6, most_amount = 1e-3;  // of the unknowns, for differences
constexpr double residual_change = 1e-3;                   // of the residuals, likewise
constexpr double least_part = 1e-5;   // of the scale: creep at a relaxed modulus of less has no digits left
constexpr double improvement = 1e-3;  // of a sum of squares, over the noise: the next linear problem would be the same
constexpr double small_excess = 0.1;  // of a sum of squares over the least
constexpr double shortest_step = 1e-3;  // towards the minimum of the linear problem
constexpr double weights[] = {1e2, 1e5,
                              1e8};   // of a figure over its value, beside residuals: as accurate as data may be
constexpr double first_reach = 0.05;  // of the search for an end, in parts of the value
constexpr double farthest = 1e3;      // likewise: open
constexpr double open_from = 100.0;   // by rounding of the slopes, which find an end far away
constexpr double near_goal = 1e-3;    // of the root of the allowance
constexpr int most_turns = 60;

std::vector<double> grid_of(const PronyLaw& law, const TimeWindow& window, const SpectrumReach& reach) {
  const TimeWindow wide{window.shortest / reach.faster, window.longest * reach.slower};
  const double decades = std::log10(wide.longest / wide.shortest);
  std::vector<double> times = spread_times(wide, static_cast<int>(std::ceil(per_decade * decades)) + 1);
  for (const PronyBranch& branch : law.shear) times.push_back(branch.time);
  std::ranges::sort(times);
  const auto doubled = std::ranges::unique(times);
  times.erase(doubled.begin(), doubled.end());
  return times;
}

Eigen::VectorXd residuals_of(const PronyLaw& law, const ViscoelasticExperiments& experiments,
                             std::span<const double> deviations) {
  const std::vector<double> values = fit_residuals(law, experiments, deviations);
  return Eigen::VectorXd::Map(values.data(), std::ssize(values));
}

LawModuli moduli_of(const PronyLaw& law) { return {young_modulus(law), shear_modulus(law)}; }

/// Root of a rising function of a reach that begins at zero with -goal, by regula falsi (Illinois). `above`: returns
/// the function; the last call is at the root. False: it stays below up to the farthest reach.
bool reach_goal(double goal, const std::function<double(double)>& above) {
  double low = 0.0, high = 0.0, f_low = -goal, f_high = 0.0, reach = first_reach;
  for (int turn = 0; turn < most_turns; ++turn) {
    const double f = above(reach);
    if (std::abs(f) <= near_goal * goal) return true;
    if (f > 0.0) {
      if (high > 0.0) f_low *= 0.5;
      high = reach, f_high = f;
    } else {
      if (high > 0.0) f_high *= 0.5;
      low = reach, f_low = f;
      if (high == 0.0 && reach >= farthest) return false;
    }
    reach = high > 0.0 ? (low * f_high - high * f_low) / (f_high - f_low)
                       : std::min(reach * std::clamp(goal / (f + goal), 1.2, 10.0), farthest);
  }
  return high > 0.0;
}

}  // namespace

AllowedSpectra::AllowedSpectra(const ViscoelasticFit& fit, const ViscoelasticExperiments& experiments,
                               std::span<const double> deviations, const SpectrumReach& reach)
    : given_(fit.law),
      holds_relaxed_(!fit.choice.young_modulus),
      holds_poisson_ratio_(!fit.choice.poisson_ratio),
      times_(grid_of(fit.law, time_window(experiments), reach)),
      scale_(shear_modulus(fit.law).instantaneous()),
      best_(fit.law) {
  const auto n = std::ssize(times_);
  x_ = Eigen::VectorXd::Zero(1 + n + (holds_poisson_ratio_ ? 0 : 2));
  x_[0] = given_.relaxed.mu / scale_;
  for (const PronyBranch& branch : given_.shear)
    x_[1 + (std::ranges::lower_bound(times_, branch.time) - times_.begin())] += branch.modulus / scale_;
  amounts_ = Eigen::VectorXd::Constant(x_.size(), least_amount);
  descend(experiments, deviations);
  at_best_ = moduli_of(best_);
  for (Eigen::Index j = 0; j < x_.size(); ++j) moduli_beside_.push_back(moduli_of(beside(best_, j, amounts_[j])));
}

void AllowedSpectra::descend(const ViscoelasticExperiments& experiments, std::span<const double> deviations) {
  const auto sum_of = [&](const Eigen::VectorXd& x) {
    return residuals_of(law_of(x), experiments, deviations).squaredNorm();
  };
  double sum = sum_of(x_);
  for (int turn = 0; turn < most_turns; ++turn) {
    linearise(experiments, deviations);
    const Eigen::VectorXd x = non_negative_least_squares(R_, right_);
    least_sum_ = (R_ * x - right_).squaredNorm();
    is_least_ = sum - least_sum_ <= small_excess;
    if (sum - least_sum_ <= improvement) break;
    // A fast branch as stiff as the bulk makes tension less than linear: as far as it is.
    double length = 1.0, there = sum_of(x);
    while (there > sum - 0.1 * length * (sum - least_sum_) && length > shortest_step) {
      length *= 0.5;
      there = sum_of(x_ + length * (x - x_));
    }
    if (!(there < sum)) break;
    is_least_ = false;
    x_ += length * (x - x_);
    sum = there;
    best_ = law_of(x_);
  }
}

PronyLaw AllowedSpectra::beside(const PronyLaw& law, Eigen::Index j, double more) const {
  PronyLaw result = law;
  const auto n = std::ssize(times_);
  double mu = law.relaxed.mu, K = law.relaxed.bulk_modulus();
  if (j == 0 && !holds_relaxed_) mu += more * scale_;
  if (j > n) K *= 1.0 + (j == n + 1 ? more : -more);
  if (j == 0 || j > n)
    result.relaxed = {.lambda = K - 2.0 / 3.0 * mu, .mu = mu};
  else
    result.shear.push_back({more * scale_, times_[static_cast<std::size_t>(j - 1)]});
  return result;
}

PronyLaw AllowedSpectra::law_of(const Eigen::VectorXd& x) const {
  PronyLaw law = given_;
  const auto n = std::ssize(times_);
  const double mu = holds_relaxed_ ? given_.relaxed.mu : std::max(x[0], least_part) * scale_;
  const double K = given_.relaxed.bulk_modulus() * (holds_poisson_ratio_ ? 1.0 : std::exp(x[n + 1] - x[n + 2]));
  law.relaxed = {.lambda = K - 2.0 / 3.0 * mu, .mu = mu};
  law.shear.clear();
  for (Eigen::Index i = 1; i <= n; ++i)
    if (x[i] > 0.0) law.shear.push_back({x[i] * scale_, times_[static_cast<std::size_t>(i - 1)]});
  return law;
}

void AllowedSpectra::linearise(const ViscoelasticExperiments& experiments, std::span<const double> deviations) {
  const Eigen::VectorXd residuals = residuals_of(best_, experiments, deviations);
  const Eigen::Index k = x_.size();
  Eigen::MatrixXd both(residuals.size(), k + 1);
  for (Eigen::Index j = 0; j < k; ++j) {
    both.col(j) = (residuals_of(beside(best_, j, amounts_[j]), experiments, deviations) - residuals) / amounts_[j];
    amounts_[j] =
        std::clamp(residual_change / std::max(both.col(j).norm(), residual_change), least_amount, most_amount);
  }
  both.col(k) = both.leftCols(k) * x_ - residuals;
  if (both.rows() > k) both = upper_triangle(both);
  R_ = both.leftCols(k);
  right_ = both.col(k);
}

Eigen::VectorXd AllowedSpectra::slopes_of(const ModuliFigure& figure) const {
  const double there = figure(at_best_);
  Eigen::VectorXd slopes(x_.size());
  for (Eigen::Index j = 0; j < x_.size(); ++j)
    slopes[j] = (figure(moduli_beside_[static_cast<std::size_t>(j)]) - there) / amounts_[j];
  return slopes;
}

std::optional<SpectrumExtreme> AllowedSpectra::end_of(const ModuliFigure& figure, double allowance, double sign) const {
  const Eigen::VectorXd slopes = slopes_of(figure);
  const double there = figure(at_best_), size = std::max(std::abs(there), 1e-6 * slopes.lpNorm<Eigen::Infinity>());
  if (!(size > 0.0)) return SpectrumExtreme{there, best_};
  Eigen::MatrixXd A(R_.rows() + 1, R_.cols());
  Eigen::VectorXd b(A.rows()), x = x_;
  b.head(right_.size()) = right_;
  double weight = 0.0;
  // The minimum with one more datum, the figure at a distance, is the end for the sum of squares that it has.
  const auto above = [&](double reach) {
    b[b.size() - 1] = weight * (slopes.dot(x_) / size + sign * reach);
    x = non_negative_least_squares(A, b);
    return std::sqrt(std::max((R_ * x - right_).squaredNorm() - least_sum_, 0.0)) - std::sqrt(allowance);
  };
  bool is_reached = false;
  for (const double next : weights) {
    weight = next;
    A << R_, weight / size * slopes.transpose();
    is_reached = reach_goal(std::sqrt(allowance), above);
    if (is_reached) break;
  }
  if (sign > 0.0 && (!is_reached || slopes.dot(x - x_) > open_from * size)) return std::nullopt;
  return SpectrumExtreme{there + slopes.dot(x - x_), law_of(x)};
}

std::optional<SpectrumExtreme> AllowedSpectra::lowest(const ModuliFigure& figure, double allowance) const {
  return end_of(figure, allowance, -1.0);
}

std::optional<SpectrumExtreme> AllowedSpectra::highest(const ModuliFigure& figure, double allowance) const {
  return end_of(figure, allowance, 1.0);
}

}  // namespace pfdm
