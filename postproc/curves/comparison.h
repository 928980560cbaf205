#pragma once
// A computed curve against measured ones, over the range that all of them cover.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// y over x, linear in between; x does not fall. SI.
struct SampledCurve {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> deviation{};  ///< standard deviation of y; empty if it is not known
  /// Of a computed curve: the row behind which something debonds first, in the step to the next one. Nothing where
  /// nothing debonds, or it is not known.
  std::optional<std::size_t> first_debonding{};

  /// At x, which lies in the curve's range.
  double at(double x) const;
};

/// The curve of a test that is driven by its displacement: where the computed one falls back (path-following), the
/// force drops at the largest displacement so far to the branch that continues there. What debonds while it falls back
/// debonds in that drop.
SampledCurve driven_curve(const SampledCurve& followed);

/// At points evenly spaced over the common range.
struct ComparedCurves {
  std::vector<double> x;
  std::vector<double> model;
  std::vector<double> measured;   ///< mean of the specimens
  std::vector<double> deviation;  ///< of the specimens about their mean, or as the only one gives it; empty if unknown
  double rms = 0.0;               ///< of model less measured
  double largest = 0.0;           ///< difference in magnitude
  double x_of_largest = 0.0;
  double largest_measured = 0.0;  ///< |y|, which the differences may be compared with
  /// Share of the points where the model lies within two standard deviations of the measured.
  std::optional<double> share_in_band;
};

/// Throws InputError if a curve has less than two points or an x that falls, if there is no specimen, or if no range is
/// common to all.
ComparedCurves compare_curves(const SampledCurve& model, const std::vector<SampledCurve>& specimens);

/// Figures of a force-displacement curve up to a displacement.
struct CurveFigures {
  double initial_stiffness = 0.0;     ///< least-squares slope between two displacements [N/m]
  double peak_force = 0.0;            ///< largest [N]
  double displacement_at_peak = 0.0;  ///< [m]
  double work = 0.0;                  ///< int F du over the range [J]
};

/// Over the displacements [from, to] [m]; the slope between `stiffness_from` and `stiffness_to`, none if they do not
/// lie in that range.
CurveFigures figures_of(const SampledCurve& curve, double from, double to, double stiffness_from, double stiffness_to);

/// The first x where y exceeds a threshold; none if it never does.
std::optional<double> onset_of(const SampledCurve& curve, double threshold);

}  // namespace pfdm
