#pragma once
// Whether residuals of unknown noise scatter evenly, as the intervals of a fit take them to.

#include "solver/calibration/calibration.h"

#include <vector>

namespace pfdm {

/// How far the scatter of residuals depends on the size of what was measured, as that of a load cell whose error is a
/// share of the force does.
struct UnevenScatter {
  /// That even noise orders the squares of residuals by size as much (Spearman, Am. J. Psychol. 15 (1904) 72).
  double probability = 1.0;
  double median = 0.0;              ///< of the sizes
  double small = 0.0, large = 0.0;  ///< rms of the residuals where the model has less than the median, and others
  /// Of the standard error of each estimate, without assuming even noise, over the one by even noise, at least 1
  /// (White, Econometrica 48 (1980) 817; HC2 of MacKinnon and White, J. Econometrics 29 (1985) 305). Empty: not known.
  std::vector<double> widening{};
  double freedom = 0.0;  ///< degrees of freedom of their Student's t

  double widest() const;  ///< 1 where it is not known
};

/// `sizes`: the model's, not negative, where the first residuals of the result are; others, as those of events, are
/// left out. Not what was measured: where the model has no force that is the residual itself. Fewer than 16 values, and
/// fits without derivatives, say nothing.
UnevenScatter uneven_scatter(const FitResult& result, const std::vector<double>& sizes);

}  // namespace pfdm
