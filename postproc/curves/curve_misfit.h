#pragma once
// Measured curves point by point, as what a least-squares fit of a computed curve has to meet.

#include "postproc/curves/measured_curve.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pfdm {

/// The points of some specimens within a range.
struct MeasuredPoints {
  struct Point {
    std::size_t specimen = 0;
    double x = 0.0, y = 0.0;
    double deviation = 0.0;  ///< standard deviation of y; 0: not known
  };
  std::vector<Point> points;    ///< one specimen after the other, in the order of their curves
  bool noise_is_known = false;  ///< of all specimens
  double rms = 0.0;             ///< of y
};

/// With x in [from, to]. Throws InputError if there is none, or if a standard deviation is zero: such a point would
/// weigh without bound.
MeasuredPoints points_between(const std::vector<SampledCurve>& specimens, double from, double to);

/// Likewise, with x as it was recorded: x of the specimen is in [from, to], and x recorded at most `latest`, one for
/// each specimen.
MeasuredPoints points_between(const std::vector<MeasuredCurve>& specimens, double from, double to,
                              const std::vector<double>& latest);

/// One computed curve for all specimens, or one for each.
using ModelCurves = std::vector<SampledCurve>;

/// Model less measurement at each point, over its standard deviation, or over the rms of all y where not every specimen
/// has one. Nothing if the model's curve does not reach all points.
std::optional<std::vector<double>> residuals_of(const ModelCurves& models, const MeasuredPoints& measured);
inline std::optional<std::vector<double>> residuals_of(const SampledCurve& model, const MeasuredPoints& measured) {
  return residuals_of(ModelCurves{model}, measured);
}

/// Rms of residuals_of(), not finite where there are none.
double rms_residual(const ModelCurves& models, const MeasuredPoints& measured);

/// What offsets of force and displacement, a compliance in line with the specimen and wrong scales would add to the
/// residuals, to first order: a column each.
std::vector<std::vector<double>> set_up_errors(const ModelCurves& models, const MeasuredPoints& measured);
inline std::vector<std::vector<double>> set_up_errors(const SampledCurve& model, const MeasuredPoints& measured) {
  return set_up_errors(ModelCurves{model}, measured);
}

/// Rms of model less measurement of one specimen; as y.
double rms_difference(const SampledCurve& model, const MeasuredPoints& measured, std::size_t specimen);

}  // namespace pfdm
