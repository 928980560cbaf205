#pragma once
// Over-relaxation of the staggered loop's damage increments: one secant factor for the whole field (Aitken's in vector
// form: Irons, Tuck, IJNME 1 (1969) 275) times a relaxation factor of each cell's own. The latter halves whenever the
// cell's increment changes sign and recovers while it does not, so that a few oscillating cells neither prevent
// convergence nor slow down the rest. If the iteration makes little net progress, for example where a crack may lie in
// either of two layers of cells, the largest secant factor is reduced towards that of plain alternation. If it still
// has a limit cycle, Anderson acceleration starts from the mean of the cycle.

#include "solver/fracture/anderson.h"

#include <optional>

namespace pfdm {

/// Net change over summed change of a field, for each stretch of so many steps: 1 on a straight line, near 0 on a limit
/// cycle. Both are sums of absolute values over the cells.
class Progress {
 public:
  explicit Progress(int stretch) : stretch_(stretch) {}
  /// The ratio for the stretch that this step ends, if it ends one.
  std::optional<double> of_step(const CellField<double>& from, const CellField<double>& to);
  /// Mean of the fields after each step of the last stretch; valid once it has ended.
  CellField<double> mean() const;

 private:
  int stretch_;
  CellField<double> begin_, sum_;
  double way_ = 0.0;
  int steps_ = 0;
};

class Relaxation {
 public:
  /// The next damage iterate, given the present one and the solution of the damage equation; bounded by `lower` and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

  /// Whether Anderson acceleration has a limit cycle too: more iterations will hardly converge.
  bool goes_in_circles() const { return mixing_ && circles_ >= most_circles; }

 private:
  CellField<double> over_relaxed(const CellField<double>& d, const CellField<double>& answer,
                                 const CellField<double>& lower);

  static constexpr double most_factor = 5.0;
  static constexpr int most_circles = 2;

  CellField<double> increment_;  // of the iteration before
  CellField<double> share_;      // relaxation factor of each cell, at most 1
  double factor_ = 1.0;
  double largest_factor_ = most_factor;
  Progress progress_{12}, long_progress_{48};
  int circles_ = 0;  // successive long stretches with almost no net change
  std::optional<AndersonMixing> mixing_;
};

}  // namespace pfdm
