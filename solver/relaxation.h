#pragma once
// Acceleration of the staggered loop's damage increments: one secant factor for the whole field (Aitken's in vector
// form: Irons, Tuck, IJNME 1 (1969) 275) times a share of each cell's own, which halves whenever the cell's increment
// changes sign and recovers while it does not: a few cells that would swing for ever neither go on nor hold up the
// rest. Where the steps of all together lead nowhere, as where a crack may be in one layer of cells or in the next, the
// factor is taken back towards that of plain alternation; if that goes in circles too, Anderson's mixing goes on from
// the middle of them.

#include "solver/anderson.h"

#include <optional>

namespace pfdm {

/// How far stretches of so many steps of a field come, over the way that they go: 1 on a straight line, near 0 on a
/// circle. Sums over the cells.
class Progress {
 public:
  explicit Progress(int stretch) : stretch_(stretch) {}
  /// Of the stretch that this step ends, if it ends one.
  std::optional<double> of_step(const CellField<double>& from, const CellField<double>& to);
  /// Of the fields that the steps of the last stretch led to; once it has ended.
  CellField<double> mean() const;

 private:
  int stretch_;
  CellField<double> begin_, sum_;
  double way_ = 0.0;
  int steps_ = 0;
};

class Relaxation {
 public:
  /// The damage to go on from, given the present one and what the damage equation answers to it; bounded by `lower`
  /// and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

  /// Whether mixing has not led out of circles either: more iterations hardly will.
  bool goes_in_circles() const { return mixing_ && circles_ >= most_circles; }

 private:
  CellField<double> over_relaxed(const CellField<double>& d, const CellField<double>& answer,
                                 const CellField<double>& lower);

  static constexpr double most_factor = 5.0;
  static constexpr int most_circles = 2;

  CellField<double> increment_;  // the one before
  CellField<double> share_;      // of its increment that each cell may take, at most 1
  double factor_ = 1.0;
  double largest_factor_ = most_factor;
  Progress progress_{12}, long_progress_{48};
  int circles_ = 0;  // long stretches in a row that came to hardly anything
  std::optional<AndersonMixing> mixing_;
};

}  // namespace pfdm
