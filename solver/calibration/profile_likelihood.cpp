#include "solver/calibration/profile_likelihood.h"

#include "physics/error.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/calibration/held_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace pfdm {
namespace {

constexpr double first_reach = 0.1;  // of the logarithm or the value, where the linear interval is unknown
constexpr double most_growth = 4.0;  // of a reach, from point to point
constexpr double better_by = 0.05;   // of s^2: a sum of squares smaller by more is another minimum

/// Walks from the estimate to one end of the interval.
class ProfileSide {
 public:
  ProfileSide(const FitProblem& problem, const FitSettings& settings, const FitResult& result, std::size_t k,
              const ProfileSettings& how, double sign, ProfileInterval& found)
      : problem_(problem),
        to_the_end_(from_one_start(settings)),
        result_(result),
        k_(k),
        how_(how),
        sign_(sign),
        found_(found) {
    const double n = static_cast<double>(result.residuals.size());
    const double freedom = n - static_cast<double>(problem.parameters.size());
    variance_ = problem.noise_is_known ? 1.0 : result.sum_of_squares / freedom;
    due_ = how.due.value_or(problem.noise_is_known ? student_95(1e9) : student_95(freedom));
    to_the_end_.iterated = {};
    is_refined_ = settings.differences != Differences::shared || settings.ends_on_grid;
  }

  /// The end in the parameter itself, and whether it is a bound.
  std::pair<double, bool> end() {
    below_ = {.reach = 0.0, .deviations = 0.0};
    const double last = reach_of(bound());
    if (!(last > 0.0)) return {estimate(), true};
    double reach = std::min(linear_reach(), last);
    for (int i = 0; i < how_.most_points; ++i) {
      Point point{.reach = reach, .deviations = deviations_at(reach)};
      if (is_end(point) && !is_refined_) point = refined(point);
      if (is_end(point)) return {value_at(interpolated(point)), false};
      const bool is_below = point.deviations < due_;
      same_side_ = i > 0 && is_below == was_below_ ? same_side_ + 1 : 0;
      was_below_ = is_below;
      if (is_below)
        below_ = point;
      else
        above_ = point;
      if (reach >= last && point.deviations < due_) return {bound(), true};
      reach = std::min(next_reach(), last);
    }
    return {value_at(next_reach()), false};
  }

 private:
  struct Point {
    double reach;  // from the estimate, in the scale of the fit
    double deviations;
  };

  bool is_end(const Point& point) const { return std::abs(point.deviations - due_) <= how_.precision * due_; }

  /// To the end, as all later ones. The grid makes sums of squares larger, and points seem to be above that are not.
  Point refined(const Point& tried) {
    is_refined_ = true;
    found_.points.pop_back();
    const Point point{.reach = tried.reach, .deviations = deviations_at(tried.reach)};
    if (!is_end(point)) above_.reset();
    return point;
  }

  const FitParameter& parameter() const { return problem_.parameters[k_]; }
  double estimate() const { return result_.estimates[k_].value; }
  double bound() const { return sign_ > 0.0 ? parameter().upper : parameter().lower; }
  double reach_of(double value) const {
    if (!parameter().log_scale) return sign_ * (value - estimate());
    return value > 0.0 ? sign_ * std::log(value / estimate()) : std::numeric_limits<double>::infinity();
  }
  double value_at(double reach) const {
    return parameter().log_scale ? estimate() * std::exp(sign_ * reach) : estimate() + sign_ * reach;
  }

  double linear_reach() const {
    const auto index = static_cast<Eigen::Index>(k_);
    const double error = std::sqrt(result_.covariance(index, index));
    if (error > 0.0 && std::isfinite(error)) return due_ * error;
    return first_reach * (parameter().log_scale ? 1.0 : std::max(std::abs(estimate()), std::abs(parameter().first)));
  }

  // Deviations grow nearly in proportion to the reach.
  double next_reach() const {
    if (!above_) {
      const double factor = below_.deviations > 0.0 ? 1.05 * due_ / below_.deviations : most_growth;
      return below_.reach * std::clamp(factor, 1.1, most_growth);
    }
    if (same_side_ > 1) return 0.5 * (below_.reach + above_->reach);
    const double share = (due_ - below_.deviations) / (above_->deviations - below_.deviations);
    return below_.reach + std::clamp(share, 0.05, 0.95) * (above_->reach - below_.reach);
  }

  // The end on the line through the last point and the nearest other one.
  double interpolated(const Point& last) const {
    Point other = below_;
    if (above_ && std::abs(above_->deviations - due_) < std::abs(below_.deviations - due_)) other = *above_;
    const double apart = last.deviations - other.deviations;
    if (!(std::abs(apart) > how_.precision * due_)) return last.reach;
    return last.reach + (due_ - last.deviations) * (last.reach - other.reach) / apart;
  }

  double deviations_at(double reach) {
    const double value = std::clamp(value_at(reach), parameter().lower, parameter().upper);
    if (how_.trying) how_.trying(k_, value);
    ProfilePoint point{.value = value, .deviations = 0.0, .others = {}};
    const double growth = (problem_.parameters.size() == 1 ? alone(value) : together(value, reach, point)) / variance_;
    point.deviations = sign_ * std::sqrt(std::max(0.0, growth));
    found_.points.push_back(point);
    if (growth < -better_by && (!found_.better || growth < better_growth_)) {
      found_.better = point;
      better_growth_ = growth;
    }
    last_ = found_.points.back();
    return std::abs(point.deviations);
  }

  double alone(double value) {
    ++found_.evaluations;
    const auto residuals = problem_.residuals(std::span(&value, 1));
    if (!residuals) fail(value);
    double sum = 0.0;
    for (const double r : *residuals) sum += r * r;
    return sum - result_.sum_of_squares + prior_term(parameter(), value) - prior_term(parameter(), estimate());
  }

  double together(double value, double reach, ProfilePoint& point) {
    try {
      const FitResult held = fit(with_held(problem_, k_, value, start_of_others(value, reach)),
                                 is_refined_ ? to_the_end_ : on_grid(to_the_end_));
      found_.evaluations += held.evaluations;
      point.others = held.values();
      return growth_of_squares(problem_, result_, k_, value, held);
    } catch (const NoConvergence&) {
      fail(value);
    }
  }

  [[noreturn]] void fail(double value) const {
    throw NoConvergence(fmt::format("the profile of {}: the model does not converge with {:.5g} {}", parameter().name,
                                    value, parameter().unit));
  }

  /// On from the last point in the direction from the estimates to it.
  std::vector<double> start_of_others(double value, double reach) const {
    if (last_.others.empty()) return others_by_linear_model(problem_, result_, k_, value);
    const double factor = reach / std::abs(reach_of(last_.value));
    std::vector<double> others;
    for (std::size_t i = 0; i < last_.others.size(); ++i) {
      const std::size_t j = i < k_ ? i : i + 1;
      const double from = result_.estimates[j].value, to = last_.others[i];
      others.push_back(problem_.parameters[j].log_scale ? from * std::pow(to / from, factor)
                                                        : from + factor * (to - from));
    }
    return others;
  }

  const FitProblem& problem_;
  FitSettings to_the_end_;
  const FitResult& result_;
  std::size_t k_;
  const ProfileSettings& how_;
  double sign_;
  ProfileInterval& found_;
  double variance_ = 1.0, due_ = 2.0, better_growth_ = 0.0;
  Point below_{};
  std::optional<Point> above_;
  bool was_below_ = false;
  bool is_refined_ = true;  // the others are estimated to the end, not only on the grid of shared differences
  int same_side_ = 0;       // points in a row on the same side of the end, less one
  ProfilePoint last_;
};

}  // namespace

ProfileInterval profile_interval(const FitProblem& problem, const FitSettings& settings, const FitResult& result,
                                 std::size_t k, const ProfileSettings& how) {
  ProfileInterval found;
  std::tie(found.lower_95, found.lower_open) = ProfileSide(problem, settings, result, k, how, -1.0, found).end();
  std::tie(found.upper_95, found.upper_open) = ProfileSide(problem, settings, result, k, how, 1.0, found).end();
  found.points.push_back({.value = result.estimates[k].value, .deviations = 0.0, .others = {}});
  for (std::size_t j = 0; j < result.estimates.size(); ++j)
    if (j != k) found.points.back().others.push_back(result.estimates[j].value);
  std::ranges::sort(found.points, {}, &ProfilePoint::value);
  return found;
}

}  // namespace pfdm
