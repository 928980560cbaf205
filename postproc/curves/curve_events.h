#pragma once
// Events of a force-displacement curve as data of their own: a jump, at which the force falls at once, the greatest
// force, and the first debonding, which need not be seen in the force. Pointwise residuals of a curve that jumps are a
// staircase in the parameters; where it jumps, and between which forces, is not.

#include "postproc/curves/curve_jumps.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

enum class EventKind { jump, greatest_force, first_debonding };
std::string_view name_of(EventKind kind);  ///< "greatest force"

/// What is measured of an event. A jump, and the first debonding, has a displacement and the forces before and after
/// it, a greatest force has a displacement and the force.
enum class EventFigure { displacement, force_before, force_after, force };
std::string_view name_of(EventFigure figure);  ///< "force_before"
std::string_view unit_of(EventFigure figure);  ///< "m", "N"
/// Of its name: "force before".
std::string in_words(std::string_view name);
inline std::string in_words(EventFigure figure) { return in_words(name_of(figure)); }

struct MeasuredFigure {
  EventFigure figure = EventFigure::displacement;
  double value = 0.0;
  double deviation = 0.0;  ///< its standard deviation
  bool counts = true;      ///< false: it is told, and is no datum
};

struct MeasuredEvent {
  EventKind kind = EventKind::jump;
  std::size_t specimen = 0;
  std::optional<int> number{};       ///< of a jump, along the curve from 1; none: the one that is nearest to `place`
  double least_fall = fall_of_jump;  ///< in one step, of the largest force: less is no jump
  double place = 0.0;                ///< displacement at which it was recorded [m]
  bool is_found = false;             ///< in the rows of the record; otherwise the case states it
  std::vector<MeasuredFigure> figures{};

  std::string name() const;  ///< "jump 2", "jump at 155 um", "greatest force", "first debonding"
  /// Of a displacement that counts; zero without one.
  double deviation_of_place() const;
};

/// The event of a specimen, and its data with their standard deviations.
std::string event_words(const MeasuredEvent& event, std::string_view specimen);

struct ComputedEvent {
  bool is_there = false;
  std::size_t before = 0, after = 0;  ///< rows of the curve; of a greatest force both its own
  double displacement = 0.0;
  double step = 0.0;  ///< in which it is [m]: its displacement is a place within; zero if it is not there
  double force_before = 0.0, force_after = 0.0;  ///< of a greatest force both the force

  double of(EventFigure figure) const;
};

/// Computed less measured over the standard deviation.
double residual_of(const ComputedEvent& computed, const MeasuredFigure& measured);

/// Calls take(event, figure) for each figure that counts, in the order of the residuals.
template <class Take>
void for_each_datum(const std::vector<MeasuredEvent>& events, const Take& take) {
  for (const MeasuredEvent& event : events)
    for (const MeasuredFigure& figure : event.figures)
      if (figure.counts) take(event, figure);
}

/// A jump is one step in which the force falls by more than least_fall, or several such steps one after the other; it
/// lies in the middle of the one that falls most. Without such a step it is where the force falls most in one, beyond
/// jumps with a smaller number, and where it falls nowhere at the end of the curve: what it says then goes over into
/// that of a jump where one becomes too small or leaves the curve. The first debonding is in the middle of its step, or
/// at the end of the curve. A greatest force in the last row is not there: it has not been reached.
ComputedEvent computed_event(const MeasuredEvent& event, const SampledCurve& model);

/// Length of the step of a curve in which a displacement lies, and beyond the curve's ends of the nearest one [m].
double step_at(const SampledCurve& curve, double displacement);

/// Rows [first, end) of a model's curve between jumps that were measured, and the measured displacements between which
/// they count; infinite without a jump at that end.
struct CurvePart {
  std::size_t first = 0, end = 0;
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
};
/// One after the other; the whole curve without jumps. Which jumps part it is said at with_jumps_as_measured().
std::vector<CurvePart> parts_between_jumps(const SampledCurve& model, const std::vector<MeasuredEvent>& events,
                                           std::size_t specimen);

/// Of the curve: over so much of it a part's slope is taken with which it goes on beyond its end.
inline constexpr double share_of_slope = 0.02;

/// The model's curve with its jumps where these are measured. What lies between jumps stays where it is, and goes on
/// straight to the measured place, with the mean slope of the nearest 2 % of the curve. Jumps that are not there stay
/// out of it; of those that are the same jump of the model, or in another order, the nearest is moved. Events of other
/// specimens are of no concern.
SampledCurve with_jumps_as_measured(const SampledCurve& model, const std::vector<MeasuredEvent>& events,
                                    std::size_t specimen);

/// Whether the jumps of the specimen that the model has are each another one, and in the measured order.
bool has_jumps_in_order(const SampledCurve& model, const std::vector<MeasuredEvent>& events, std::size_t specimen);

/// Up to this displacement.
SampledCurve up_to(const SampledCurve& curve, double displacement);

}  // namespace pfdm
