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
  double small = 0.0, large = 0.0;  ///< rms of the residuals where the model has less and more than its median
  /// Of the standard error of the estimate that is least exact for it, without assuming even noise, over the one by
  /// even noise (White, Econometrica 48 (1980) 817; HC2 of MacKinnon and White, J. Econometrics 29 (1985) 305).
  double widening = 1.0;
};

/// `measured`: what the first residuals of the result, of the model less what was measured, belong to, in their unit;
/// others, as those of events, are left out. The size is the model's: where it has no force what was measured is the
/// residual itself. Fewer than 16 values, and fits without derivatives, say nothing.
UnevenScatter uneven_scatter(const FitResult& result, const std::vector<double>& measured);

}  // namespace pfdm
