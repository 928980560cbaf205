#pragma once
// Acceleration of the staggered loop. Alternate minimisation descends; Nesterov's momentum carries each iterate on
// along the last step. Where the alternation is slow, at a minimum or on the way from an unstable state, it takes the
// square root of its iterations. It starts anew whenever the increments point back (Beck, Teboulle, SIAM J. Imaging
// Sci. 2 (2009) 183; adaptive restart: O'Donoghue, Candes, Found. Comput. Math. 15 (2015) 715).
//
// Where the driving energy is not the derivative of the discrete energy (cell_stiffness.h) there is no descent, and
// momentum ends in limit cycles. There the increments are over-relaxed by one secant factor for the whole field
// (Aitken's in vector form: Irons, Tuck, IJNME 1 (1969) 275), the largest of which is reduced where the iteration makes
// little net progress.
//
// Besides, each cell has a relaxation factor of its own. It halves whenever the cell's increment changes sign and
// recovers while it does not. So a few oscillating cells neither prevent convergence nor slow down the rest. Until it
// has recovered, the cell has no momentum. If the iteration still has a limit cycle, Anderson acceleration starts from
// the mean of the cycle.

#include "solver/fracture/equilibrium/anderson.h"

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
  enum class Way { momentum, secant };
  explicit Relaxation(Way way = Way::momentum) : way_(way) {}

  /// The next damage iterate, given the present one and the solution of the damage equation; bounded by `lower` and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

  /// The damage has been moved otherwise: no momentum from the iterations before.
  void lose_momentum() {
    relaxed_ = {};
    inertia_ = 1.0;
  }

  /// Whether Anderson acceleration has a limit cycle too: more iterations will hardly converge.
  bool goes_in_circles() const { return mixing_ && circles_ >= most_circles; }

 private:
  CellField<double> renew_increment(const CellField<double>& d, const CellField<double>& answer);
  CellField<double> accelerated(const CellField<double>& d, const CellField<double>& answer,
                                const CellField<double>& lower);
  double momentum(const CellField<double>& relaxed);
  CellField<double> over_relaxed(const CellField<double>& d, const CellField<double>& answer,
                                 const CellField<double>& lower);

  static constexpr double most_factor = 5.0;
  static constexpr int most_circles = 2;

  Way way_;
  CellField<double> increment_;  // of the last iteration
  CellField<double> share_;      // relaxation factor of each cell, at most 1
  CellField<double> relaxed_;    // damage of the iteration before, without momentum
  double inertia_ = 1.0;         // t of Beck and Teboulle
  double factor_ = 1.0;          // of the secant
  double largest_factor_ = most_factor;
  Progress short_progress_{12}, progress_{48};
  int circles_ = 0;  // successive stretches with almost no net change
  std::optional<AndersonMixing> mixing_;
};

}  // namespace pfdm
