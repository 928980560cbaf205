#pragma once
// Standard errors of estimates whose residuals are correlated with their neighbours.

#include "solver/calibration/calibration.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace pfdm {

/// Of one estimate, against what independent residuals say.
struct CorrelatedError {
  double widening = 1.0;                                     ///< of its standard error, at least 1
  double freedom = std::numeric_limits<double>::infinity();  ///< degrees of freedom of its Student's t
  /// Part of the variance of its error that the residuals show; the fit takes the rest, the more the longer they are
  /// correlated against the data. Near 1 of long data.
  double visible = 1.0;
};

/// Sandwich J^+ S J^+T of a fit's estimates, S the covariance of stationary noise in each series: autocovariances of
/// the residuals by Bartlett's window over an eighth of the series, 100 lags at most (Newey, West, Econometrica 55
/// (1987) 703). What the fit has taken from the residuals is given back as it takes it from noise of first-order
/// autoregression with the same correlation of neighbours; the degrees of freedom are those of Satterthwaite for that
/// noise. Other noise is met by the window alone: where a fifth of its variance is slow, neighbours by 0.9, intervals
/// hold the truth in three of four cases with 200 values (tests/statistics). `series`: numbers of residuals, one series
/// after the other, in the order of the result's. An entry for each estimate; what the data do not determine keeps the
/// defaults.
std::vector<CorrelatedError> correlated_errors(const FitResult& result, const std::vector<std::size_t>& series);

}  // namespace pfdm
