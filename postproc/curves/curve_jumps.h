#pragma once
// Jumps of a computed curve, as where an interface debonds at once, and a curve moved so that its jumps are where those
// of another one are.

#include "postproc/curves/comparison.h"

#include <cstddef>
#include <vector>

namespace pfdm {

/// Where y falls, from one point to the next, by more than this share of its largest value: the number of the point
/// before each fall.
std::vector<std::size_t> rows_before_jumps(const SampledCurve& curve, double least_fall);

inline constexpr double fall_of_jump = 0.1;  ///< if nothing else is said

/// Likewise the x before each fall.
std::vector<double> jumps_of(const SampledCurve& curve, double least_fall = fall_of_jump);

/// What takes jumps of one curve to those of another, linear between them and up to both ends, which stay; identity
/// where the numbers of jumps differ or a jump lies at an end.
class JumpAlignment {
 public:
  JumpAlignment() = default;
  JumpAlignment(const SampledCurve& from, const SampledCurve& to, double least_fall = fall_of_jump);

  SampledCurve operator()(SampledCurve curve) const;

 private:
  std::vector<double> from_, to_;  // rising
};

}  // namespace pfdm
