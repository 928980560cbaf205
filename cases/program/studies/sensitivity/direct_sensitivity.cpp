#include "cases/program/studies/sensitivity/direct_sensitivity.h"

#include "cases/program/studies/sensitivity/curve_peak.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

// What is left of the equations, in the norm of their diagonal, hides most of slow modes: in a slender cantilever a
// share of 1e-6 was an error of 9e-5.
constexpr double worst_condition = 100.0;

// Behind one jump after another, as of a crack that breaks its cells one by one, what jumps froze makes derivatives
// grow without a bound: of a DCB to 1e151.
constexpr double no_elasticity = 100.0;

/// The error is as large as the derivative; also where it is not a number.
bool is_lost(const RowDerivative& row) { return !(worst_condition * row.unsolved <= 1.0); }

/// There is none of a state behind a jump, or that is lost, where it is past all reason.
bool is_none(double elasticity, const RowDerivative& row) {
  return (row.is_after_jump || is_lost(row)) && !(std::abs(elasticity) < no_elasticity);
}

/// Of a state behind a jump the error is not known.
Elasticity elasticity_of(double derivative, double value, const RowDerivative& row) {
  const double elasticity = derivative / value;
  if (is_none(elasticity, row)) return {};
  if (row.is_after_jump) return {.value = elasticity};
  return {.value = elasticity, .error = worst_condition * row.unsolved * std::max(1.0, std::abs(elasticity))};
}

/// Derivative of the force by ln p at fixed displacement [N].
double at_fixed_displacement(const RowDerivative& by, const RowDerivative& by_load) {
  return by.displacement == 0.0 ? by.force : by.force - by_load.force * by.displacement / by_load.displacement;
}

/// Of the displacement and the force of a peak between jumps. Unknown where the row alone is known of it.
std::vector<Elasticity> of_peak(const DirectSensitivity& direct, std::size_t j, std::size_t row) {
  const CurvePeak peak(direct.curve, CurveBranches(direct.curve), row);
  std::vector<Elasticity> found(2);
  if (peak.shape() == CurvePeak::Shape::row) return found;
  std::vector<double> change(direct.curve.x.size(), 0.0);
  for (std::size_t i = 1; i < change.size(); ++i) change[i] = at_fixed_displacement(direct.by[j][i], direct.by_load[i]);
  const auto [place, coarser] = peak.places();
  const auto [moved, by_coarser] = peak.moved_by(change);
  RowDerivative by = direct.by[j][row];
  for (std::size_t i = row - 1; i <= row + 1; ++i) by.unsolved = std::max(by.unsolved, direct.by[j][i].unsolved);
  found = {elasticity_of(moved.x, place.x, by), elasticity_of(moved.y, place.y, by)};
  const std::array apart{found[0].value - by_coarser.x / coarser.x, found[1].value - by_coarser.y / coarser.y};
  for (std::size_t q = 0; q < 2; ++q)  // of errors that are not known none is told
    if (std::abs(apart[q]) > found[q].error) found[q].error = std::abs(apart[q]);
  return found;
}

/// Of a jump its displacement alone: the forces beside it move by what the second derivatives of the equations tell.
std::vector<Elasticity> of_jump(const DirectSensitivity& direct, std::size_t j, const ComputedEvent& jump,
                                const BaseEvent& event) {
  const RowDerivative &by = direct.by[j][jump.before], &by_load = direct.by_load[jump.before];
  std::vector<Elasticity> found(event.quantities.size());
  const double displacement = by.displacement + by.jump.load * by_load.displacement;
  const double elasticity = displacement / direct.curve.x[jump.before];
  if (is_none(elasticity, by)) return found;
  found[0].value = elasticity;
  if (!by.is_after_jump) found[0].error = std::abs(by.jump.error * by_load.displacement / direct.curve.x[jump.before]);
  return found;
}

}  // namespace

void mark_lost_rows(DirectSensitivity& direct) {
  for (std::vector<RowDerivative>& rows : direct.by)
    for (auto row = std::ranges::find_if(rows, is_lost); row != rows.end(); ++row) row->is_after_jump = true;
}

std::vector<Elasticity> elasticities(const DirectSensitivity& direct, std::size_t parameter) {
  const double least = least_force(direct.curve);
  std::vector<Elasticity> found(direct.curve.x.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const RowDerivative& by = direct.by[parameter][i];
    if (std::abs(direct.curve.y[i]) >= least)
      found[i] = elasticity_of(at_fixed_displacement(by, direct.by_load[i]), direct.curve.y[i], by);
  }
  return found;
}

std::vector<Elasticity> elasticities(const DirectSensitivity& direct, std::size_t parameter, const BaseEvent& event) {
  const ComputedEvent computed = computed_event(event.event, direct.curve);
  if (!computed.is_there || event.event.kind == EventKind::first_debonding)
    return std::vector<Elasticity>(event.quantities.size());
  return event.event.kind == EventKind::jump ? of_jump(direct, parameter, computed, event)
                                             : of_peak(direct, parameter, computed.after);
}

}  // namespace pfdm
