#pragma once
// Measured curves point by point, as what a least-squares fit of a computed curve has to meet.

#include "postproc/curves/curve_events.h"
#include "postproc/curves/measured_curve.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pfdm {

/// The points of some specimens within a range, and events of their curves, which are data as well.
struct MeasuredPoints {
  struct Point {
    std::size_t specimen = 0;
    double x = 0.0, y = 0.0;
    double deviation = 0.0;  ///< standard deviation of y; 0: not known
  };
  std::vector<Point> points;    ///< one specimen after the other, in the order of their curves
  bool noise_is_known = false;  ///< of all specimens
  double rms = 0.0;             ///< of y
  /// Of each specimen, where the noise is not known: those with less scatter count more. Empty: all alike.
  std::vector<double> weight{};
  std::vector<MeasuredEvent> events{};  ///< only where the noise is known
  std::size_t left_out = 0;             ///< points in whose place events count

  /// Residuals: points, and what counts of events.
  std::size_t n_data() const {
    std::size_t n = points.size();
    for_each_datum(events, [&](const MeasuredEvent&, const MeasuredFigure&) { ++n; });
    return n;
  }
  /// That a residual of this point is divided by [as y].
  double scale(const Point& point) const {
    if (noise_is_known) return point.deviation;
    return weight.empty() ? rms : rms / weight[point.specimen];
  }
};

/// Throws InputError if a standard deviation is zero.
void require_deviations(const std::vector<MeasuredCurve>& specimens);

/// With x in [from, to]. Throws InputError if there is none, or if a standard deviation is zero: such a point would
/// weigh without bound.
MeasuredPoints points_between(const std::vector<SampledCurve>& specimens, double from, double to);

/// Likewise, with x as it was recorded: x of the specimen is in [from, to], and x recorded at most `latest`, one for
/// each specimen.
MeasuredPoints points_between(const std::vector<MeasuredCurve>& specimens, double from, double to,
                              const std::vector<double>& latest);

/// One computed curve for all specimens, or one for each.
using ModelCurves = std::vector<SampledCurve>;

/// Weights by which the scatter of each specimen about the model is the same, at most a factor of ten apart, with a
/// mean square of 1 over all points; empty where they hardly differ (by less than a fifth) or there is but one
/// specimen. `residuals`: of these points.
std::vector<double> weights_by_scatter(const std::vector<double>& residuals, const MeasuredPoints& measured);

/// Model less measurement at each point, over MeasuredPoints::scale(): its standard deviation, or the rms of all y
/// where not every specimen has one. With events the model's jumps are moved to where those are measured
/// (with_jumps_as_measured), and behind the points come the figures of the events that count, over their standard
/// deviations. Nothing if the model's curve does not reach all points.
std::optional<std::vector<double>> residuals_of(const ModelCurves& models, const MeasuredPoints& measured);
inline std::optional<std::vector<double>> residuals_of(const SampledCurve& model, const MeasuredPoints& measured) {
  return residuals_of(ModelCurves{model}, measured);
}

/// Likewise with the mean of the model's curve about each point, as far to both sides as half the way from the point
/// before to the one after. Where the curve jumps or has a corner, the derivatives of residuals_of() depend on where
/// the points happen to lie and on the load steps; those of means do not. No mean reaches over a jump that is an event:
/// the curve is parted there.
std::optional<std::vector<double>> averaged_residuals_of(const ModelCurves& models, const MeasuredPoints& measured);

/// Rms of residuals_of(), not finite where there are none.
double rms_residual(const ModelCurves& models, const MeasuredPoints& measured);

/// Rms of the differences that residuals_of() stand for at the points, over the rms of all y.
double relative_misfit(const std::vector<double>& residuals, const MeasuredPoints& measured);

/// What offsets of force and displacement, a compliance in line with the specimen and wrong scales would add to the
/// residuals, to first order: a column each.
std::vector<std::vector<double>> set_up_errors(const ModelCurves& models, const MeasuredPoints& measured);
inline std::vector<std::vector<double>> set_up_errors(const SampledCurve& model, const MeasuredPoints& measured) {
  return set_up_errors(ModelCurves{model}, measured);
}
/// The offset of force, to be taken from the measured ones [as y], that explains residuals best together with the
/// others of set_up_errors().
double explaining_force_offset(const std::vector<double>& residuals, const std::vector<std::vector<double>>& errors);

/// Whether an offset of the force, above 5 % of the largest, is that of no curve that begins, as this one, at less than
/// 2 % of it: its specimen would have been loaded before the record began.
bool contradicts_unloaded_start(const SampledCurve& curve, double force_offset);

/// Rms of model less measurement of one specimen; as y.
double rms_difference(const SampledCurve& model, const MeasuredPoints& measured, std::size_t specimen);

}  // namespace pfdm
