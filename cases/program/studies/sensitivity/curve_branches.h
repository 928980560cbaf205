#pragma once
// A computed curve as smooth branches between its jumps.

#include "postproc/curves/comparison.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pfdm {

class CurveBranches {
 public:
  /// Keeps a reference to the curve. A branch ends where the force falls at once (curve_jumps.h), or the displacement
  /// does not grow.
  explicit CurveBranches(const SampledCurve& curve);

  struct Place {
    std::size_t branch = 0;
    double y = 0.0;
  };
  /// On the branch that reaches over x, by the cubic through the four nearest rows. Nothing between branches and beyond
  /// the ends.
  std::optional<Place> at(double x) const;

  std::size_t n() const { return first_.size() - 1; }
  /// |dy/dx| about a row, along its branch; zero of a branch of one row.
  double slope(std::size_t row) const;

  std::size_t branch_of(std::size_t row) const;

 private:
  double interpolated(std::size_t branch, double x) const;

  const SampledCurve& curve_;
  std::vector<std::size_t> first_;  // row of each branch, and the number of rows
};

}  // namespace pfdm
