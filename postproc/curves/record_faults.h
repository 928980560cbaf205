#pragma once
// Faults of a record that a computed curve shows: the sign of its forces, their unit, an offset that a few rows tell.

#include "postproc/curves/curve_misfit.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Displacement at zero force, with which a record begins before the specimen carries.
struct Slack {
  std::size_t n_rows = 0;          ///< at zero force: within 2 % of the largest
  double until = 0.0;              ///< displacement of the last of them [m]
  double origin = 0.0, error = 0;  ///< where the rise behind them meets zero force, its standard error [m]
  double from = 0.0, to = 0.0;     ///< forces between which the rise was taken [N]
};
/// Three rows at least, none of negative displacement, that end where the rise begins: a toe, which bends, is none.
/// Nothing where the origin is not significantly beyond the first row, or by less than 2 % of the way to the largest
/// force.
std::optional<Slack> slack_at_start(const SampledCurve& measured);

/// Says that the specimen's curve begins with slack, or else misses the origin, and with which keys that is taken out.
std::optional<std::string> doubt_of_origin(const SampledCurve& measured, const SampledCurve& computed, double from,
                                           double to);

/// Measured forces of a specimen against computed ones at the same displacements.
struct ForceScale {
  double alikeness = 0.0;  ///< cosine between both, from -1 to 1; 0 where one of them is zero
  double factor = 0.0;     ///< by which the computed ones meet the measured ones best
};
ForceScale force_scale(const ModelCurves& models, const MeasuredPoints& measured, std::size_t specimen);

/// Throws InputError, with the key that turns them, for forces that have clearly the other sign than the computed ones.
/// Points below 30 % of the greatest force of a record tell nothing, here and in doubts_of_unit().
void require_same_sign(const ModelCurves& models, const MeasuredPoints& measured,
                       const std::vector<MeasuredCurve>& specimens);

/// A sentence for each specimen whose forces are 30 times the computed ones or more, or a 30th or less.
std::vector<std::string> doubts_of_unit(const ModelCurves& models, const MeasuredPoints& measured,
                                        const std::vector<MeasuredCurve>& specimens);

/// Says that the rise of specimen s, its rows up to 60 % of the greatest force, meets zero force elsewhere than the
/// computed curve of the specimen, by more than a tenth of the way to that force, with the keys that take it out. Two
/// rows serve. Nothing where they do not rise, or where `scatter`, a standard deviation of their forces [N], may
/// explain it (four standard errors).
std::optional<std::string> doubt_of_rise(const std::vector<MeasuredCurve>& specimens, std::size_t s,
                                         const SampledCurve& computed, double scatter);

/// Says that specimens disagree: of residuals that are more than noise the larger part, 70 %, is how far the specimens
/// lie apart. Over the displacements that all have; nothing of a single one.
std::optional<std::string> doubt_of_specimens(const std::vector<double>& residuals, const MeasuredPoints& measured,
                                              const std::vector<MeasuredCurve>& specimens);

}  // namespace pfdm
