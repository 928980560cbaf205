#pragma once
// Derivatives of a curve and of its events by a parameter, as elasticities d ln F/d ln p: central differences of curves
// that were computed with other values, with two steps, which tell by how much they err.

#include "postproc/curves/curve_events.h"

#include <array>
#include <limits>
#include <vector>

namespace pfdm {

/// Curves with a parameter times 1 + h, 1 - h, 1 + h/2, 1 - h/2.
struct CurvesAround {
  double step = 0.0;  ///< h
  std::array<SampledCurve, 4> curves;
};

/// A derivative of a logarithm by a logarithm; NaN where there is none. The error of differences is that from the ones
/// by h/2, and no less than what load steps hide.
struct Elasticity {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< of differences by the step h
  double error = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  bool is_known() const { return value == value; }
  /// Whether it is known, and not by how much it errs, or that is more than a twentieth of it and than a hundredth.
  bool is_doubtful() const;
};

/// A hundredth of the largest force in magnitude [N]: elasticities of less are not told.
double least_force(const SampledCurve& curve);

/// At each row of `base`. Unknown where a jump lies between the curves, where one of them does not reach, and where the
/// force is below least_force().
std::vector<Elasticity> elasticities(const SampledCurve& base, const CurvesAround& around);

/// A figure of an event of the base curve.
struct EventQuantity {
  EventFigure figure = EventFigure::displacement;
  double value = 0.0;
};

struct BaseEvent {
  MeasuredEvent event;  ///< how it is found in other curves
  double displacement = 0.0;
  std::vector<EventQuantity> quantities;
};

/// The greatest force, if it has been reached before the end, each jump, and the first debonding.
std::vector<BaseEvent> events_of(const SampledCurve& base);

/// Of each quantity of the event. Its error is no less than what the load steps leave open. Unknown where a curve lacks
/// the event.
std::vector<Elasticity> elasticities(const BaseEvent& event, const CurvesAround& around);

/// How many jumps it has.
std::size_t n_jumps(const SampledCurve& curve);

}  // namespace pfdm
