#pragma once
// Whether residuals of unknown noise scatter evenly, as the intervals of a fit take them to.

#include "solver/calibration/calibration.h"

#include <vector>

namespace pfdm {

/// How far the scatter of residuals depends on the size of what was measured, as that of a load cell whose error is a
/// share of the force does.
struct UnevenScatter {
  double probability = 1.0;         ///< that even noise gives as much (Koenker, J. Econometrics 17 (1981) 107)
  double small = 0.0, large = 0.0;  ///< rms of the residuals where less and more than the median was measured
  /// Of the standard error of the estimate that is least exact for it, without assuming even noise, over the one by
  /// even noise (White, Econometrica 48 (1980) 817; HC2 of MacKinnon and White, J. Econometrics 29 (1985) 305).
  double widening = 1.0;
};

/// `measured`: what the first residuals of the result belong to, of any unit; others, as those of events, are left
/// out. Fewer than 16 values, and fits without derivatives, say nothing.
UnevenScatter uneven_scatter(const FitResult& result, const std::vector<double>& measured);

}  // namespace pfdm
