#pragma once
// Which steps of a run a measured frame is compared with: those about the displacement at which it was taken.

#include "postproc/curves/curve_events.h"
#include "postproc/curves/measured_curve.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pfdm {

/// What a run left: its curve step by step, also where it falls back, and the displacements at the places.
struct FieldHistory {
  SampledCurve followed;                  ///< force [N] over displacement [m], a row for each step
  std::vector<std::vector<double>> rows;  ///< three numbers for each place [m]
};

/// The displacements at a frame as a sum of those of steps, whose weights add up to 1.
using StepWeights = std::vector<std::pair<std::size_t, double>>;

/// The steps along what the machine would have recorded. Where the run falls back (path-following) a test that is
/// driven by its displacement is not; the curve is parted at its measured jumps, as with_jumps_as_measured() parts
/// forces, and between the computed and the measured place of a jump a part goes on straight.
class FieldPath {
 public:
  FieldPath(const SampledCurve& followed, const SetUp& set_up, const std::vector<MeasuredEvent>& events,
            std::size_t specimen);
  /// Nothing behind the end of the run.
  std::optional<StepWeights> at(double recorded) const;
  double latest() const { return curve_.x.back(); }  ///< displacement of the record that the run reaches [m]

 private:
  struct Knot {
    std::size_t before = 0, after = 0;  ///< steps
    double share = 0.0;                 ///< of the later one
  };
  void add_inside(const CurvePart& part, double x, double weight, StepWeights& to) const;

  SampledCurve curve_;
  std::vector<Knot> knots_;  // of its rows
  std::vector<CurvePart> parts_;
};

}  // namespace pfdm
