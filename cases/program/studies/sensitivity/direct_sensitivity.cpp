#include "cases/program/studies/sensitivity/direct_sensitivity.h"

#include "cases/program/studies/sensitivity/curve_branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace pfdm {
namespace {

// What is left of the equations, in the norm of their diagonal, hides most of slow modes: in a slender cantilever a
// share of 1e-6 was an error of 9e-5.
constexpr double worst_condition = 100.0;

Elasticity elasticity_of(double derivative, double value, double unsolved) {
  return {.value = derivative / value,
          .error = worst_condition * unsolved * std::max(1.0, std::abs(derivative / value))};
}

/// Derivative of the force by ln p at fixed displacement [N].
double at_fixed_displacement(const RowDerivative& by, const RowDerivative& by_load) {
  return by.displacement == 0.0 ? by.force : by.force - by_load.force * by.displacement / by_load.displacement;
}

/// Value, slope and curvature at `at` of the polynomial through some points.
std::array<double, 3> polynomial(std::span<const double> x, std::vector<double> y, double at) {
  const std::size_t n = x.size();
  for (std::size_t k = 1; k < n; ++k)  // divided differences
    for (std::size_t i = n - 1; i >= k; --i) y[i] = (y[i] - y[i - 1]) / (x[i] - x[i - k]);
  std::array<double, 3> sums{};
  for (std::size_t i = n; i-- > 0;) {
    const double apart = at - x[i];
    sums[2] = sums[2] * apart + 2.0 * sums[1];
    sums[1] = sums[1] * apart + sums[0];
    sums[0] = sums[0] * apart + y[i];
  }
  return sums;
}

/// Rows about a peak on its branch, two to each side at most.
std::pair<std::size_t, std::size_t> rows_about(const SampledCurve& curve, std::size_t row) {
  const CurveBranches branches(curve);
  std::size_t first = row, last = row;
  for (int k = 0; k < 2; ++k) {
    if (first > 0 && branches.branch_of(first - 1) == branches.branch_of(row)) --first;
    if (last + 1 < curve.x.size() && branches.branch_of(last + 1) == branches.branch_of(row)) ++last;
  }
  return {first, last};
}

/// Of the displacement and the force of a peak between jumps, at which the force has no slope.
std::vector<Elasticity> of_peak(const DirectSensitivity& direct, std::size_t j, std::size_t row,
                                const BaseEvent& event) {
  const auto [first, last] = rows_about(direct.curve, row);
  if (first == row || last == row) return std::vector<Elasticity>(event.quantities.size());
  std::vector<double> change;
  for (std::size_t i = first; i <= last; ++i)
    change.push_back(at_fixed_displacement(direct.by[j][i], direct.by_load[i]));
  const std::span<const double> x = std::span(direct.curve.x).subspan(first, last - first + 1);
  const auto begin = direct.curve.y.begin() + static_cast<std::ptrdiff_t>(first);
  const double at = event.quantities[0].value, unsolved = direct.by[j][row].unsolved;
  const auto of_change = polynomial(x, change, at);
  const double curvature = polynomial(x, {begin, begin + static_cast<std::ptrdiff_t>(x.size())}, at)[2];
  return {elasticity_of(-of_change[1] / curvature, at, unsolved),
          elasticity_of(of_change[0], event.quantities[1].value, unsolved)};
}

/// Of a jump its displacement alone: the forces beside it move by what the second derivatives of the equations tell.
std::vector<Elasticity> of_jump(const DirectSensitivity& direct, std::size_t j, const ComputedEvent& jump,
                                const BaseEvent& event) {
  const RowDerivative &by = direct.by[j][jump.before], &by_load = direct.by_load[jump.before];
  std::vector<Elasticity> found(event.quantities.size());
  const double displacement = by.displacement + by.jump.load * by_load.displacement;
  found[0] = {.value = displacement / direct.curve.x[jump.before],
              .error = std::abs(by.jump.error * by_load.displacement / direct.curve.x[jump.before])};
  return found;
}

}  // namespace

std::vector<Elasticity> elasticities(const DirectSensitivity& direct, std::size_t parameter) {
  const double least = least_force(direct.curve);
  std::vector<Elasticity> found(direct.curve.x.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const RowDerivative& by = direct.by[parameter][i];
    if (std::abs(direct.curve.y[i]) >= least)
      found[i] = elasticity_of(at_fixed_displacement(by, direct.by_load[i]), direct.curve.y[i], by.unsolved);
  }
  return found;
}

std::vector<Elasticity> elasticities(const DirectSensitivity& direct, std::size_t parameter, const BaseEvent& event) {
  const ComputedEvent computed = computed_event(event.event, direct.curve);
  if (!computed.is_there || event.event.kind == EventKind::first_debonding)
    return std::vector<Elasticity>(event.quantities.size());
  return event.event.kind == EventKind::jump ? of_jump(direct, parameter, computed, event)
                                             : of_peak(direct, parameter, computed.before, event);
}

}  // namespace pfdm
