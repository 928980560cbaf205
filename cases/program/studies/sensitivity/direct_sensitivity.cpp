#include "cases/program/studies/sensitivity/direct_sensitivity.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

Elasticity elasticity_of(double derivative, double value, double unsolved) {
  return {.value = derivative / value, .error = unsolved * std::max(1.0, std::abs(derivative / value))};
}

/// Derivative of the force by ln p at fixed displacement [N].
double at_fixed_displacement(const RowDerivative& by, const RowDerivative& by_load) {
  return by.displacement == 0.0 ? by.force : by.force - by_load.force * by.displacement / by_load.displacement;
}

/// First and second derivative at the middle one of three points.
std::pair<double, double> derivatives_at(const double* x, const double* y) {
  const double left = x[1] - x[0], right = x[2] - x[1], a = (y[1] - y[0]) / left, b = (y[2] - y[1]) / right;
  return {(a * right + b * left) / (left + right), 2.0 * (b - a) / (left + right)};
}

/// Of the displacement and the force of a peak between jumps, at which the force has no slope.
std::vector<Elasticity> of_peak(const DirectSensitivity& direct, std::size_t j, std::size_t row,
                                const BaseEvent& event) {
  std::array<double, 3> change{};
  for (std::size_t k = 0; k < change.size(); ++k)
    change[k] = at_fixed_displacement(direct.by[j][row - 1 + k], direct.by_load[row - 1 + k]);
  const double* const x = &direct.curve.x[row - 1];
  const auto [slope, curvature] = derivatives_at(x, change.data());
  const double force_curvature = derivatives_at(x, &direct.curve.y[row - 1]).second;
  const double apart = event.quantities[0].value - direct.curve.x[row];
  const double unsolved = direct.by[j][row].unsolved;
  const double force = change[1] + apart * (slope + 0.5 * apart * curvature);
  return {elasticity_of(-(slope + apart * curvature) / force_curvature, event.quantities[0].value, unsolved),
          elasticity_of(force, event.quantities[1].value, unsolved)};
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
  const bool is_jump =
      computed_event({.kind = EventKind::jump}, direct.curve).is_there && event.event.kind == EventKind::jump;
  if (!is_jump) {
    const std::size_t row = computed.before;
    if (event.event.kind == EventKind::greatest_force && row > 0 && row + 1 < direct.curve.x.size())
      return of_peak(direct, parameter, row, event);
    return std::vector<Elasticity>(event.quantities.size());
  }
  const RowDerivative &before = direct.by[parameter][computed.before], &by_load = direct.by_load[computed.before],
                      &after = direct.by[parameter][computed.after], &load_after = direct.by_load[computed.after];
  const double load = before.load_of_jump;
  return {elasticity_of(before.displacement + load * by_load.displacement, event.displacement, before.unsolved),
          elasticity_of(before.force + load * by_load.force, event.quantities[1].value, before.unsolved),
          elasticity_of(after.force + load * load_after.force, event.quantities[2].value, after.unsolved)};
}

}  // namespace pfdm
