#pragma once
// Jumps in the rows of a record, found where its force falls more than noise lets it.

#include "postproc/curves/comparison.h"

#include <vector>

namespace pfdm {

inline constexpr std::size_t rows_of_force = 8;  ///< at most, on one side of a jump

struct RecordedJump {
  double displacement = 0.0, deviation = 0.0;  ///< and its standard deviation [m]
  /// By lines through the rows before and after, at the displacement [N], and their standard deviations.
  double force_before = 0.0, force_after = 0.0, deviation_before = 0.0, deviation_after = 0.0;
};

/// In the order of displacements: where lines through up to `rows_of_force` rows before and after differ by more than
/// `least_fall` of the largest force, and by more than four standard errors. A jump lies between two rows; which ones
/// is as probable as what two lines, one on either side, leave of the rows. Its displacement is the mean, its variance
/// that of this choice and of a place between two rows, spacing^2/12. `record` has standard deviations, and four rows
/// or more on each side of a jump.
std::vector<RecordedJump> recorded_jumps(const SampledCurve& record, double least_fall);

}  // namespace pfdm
