#pragma once
// Acceleration of the staggered loop's damage increments: one secant factor for the whole field (Aitken's in vector
// form: Irons, Tuck, IJNME 1 (1969) 275) times a share of each cell's own, which halves whenever the cell's increment
// changes sign and recovers while it does not: a few cells that would swing for ever neither go on nor hold up the
// rest. Where the steps of all together lead nowhere, as where a crack may be in one layer of cells or in the next, the
// factor is taken back towards that of plain alternation.

#include "mesh/fields.h"

#include <optional>

namespace pfdm {

/// How far stretches of so many steps of a field come, over the way that they go: 1 on a straight line, near 0 on a
/// circle. Sums over the cells.
class Progress {
 public:
  explicit Progress(int stretch) : stretch_(stretch) {}
  /// Of the stretch that this step ends, if it ends one.
  std::optional<double> of_step(const CellField<double>& from, const CellField<double>& to);

 private:
  int stretch_;
  CellField<double> begin_;
  double way_ = 0.0;
  int steps_ = 0;
};

class Relaxation {
 public:
  /// The damage to go on from, given the present one and what the damage equation answers to it; bounded by `lower`
  /// and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

  /// Whether a hundred steps or so have led nowhere; more of them hardly will.
  bool goes_in_circles() const { return circles_ > 1; }

 private:
  void watch(const CellField<double>& from, const CellField<double>& to);

  static constexpr double most_factor = 5.0;

  CellField<double> increment_;  // the one before
  CellField<double> share_;      // of its increment that each cell may take, at most 1
  double factor_ = 1.0;
  double largest_factor_ = most_factor;
  Progress progress_{12}, long_progress_{48};
  int circles_ = 0;  // long stretches in a row that came to hardly anything
};

}  // namespace pfdm
