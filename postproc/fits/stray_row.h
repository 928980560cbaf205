#pragma once
// A row of a record that lies off a fit as no row of its noise would, as one that a testing machine dropped.

#include "solver/calibration/calibration.h"

#include <optional>
#include <vector>

namespace pfdm {

struct StrayRow {
  std::size_t row = 0;       ///< among the residuals
  double distance = 0.0;     ///< of its residual, in standard deviations of one, by the other rows
  double probability = 1.0;  ///< that normal noise leaves any of the rows so far away
  double shift = 0.0;        ///< of the estimate that the row moves most, in standard errors of the fit without it
};

/// The row that is least probable, by externally studentised residuals with Bonferroni's bound (Cook and Weisberg,
/// Residuals and Influence in Regression, 1982, 2.2.2). `records`: what the first residuals belong to, in their unit,
/// one record after the other. Only rows count that lie as far from the lines through their neighbours before and
/// after, to one side: a peak does not, nor do rows beside a jump that the fit has a row too early or too late. Where
/// the noise is known, residuals that are larger all over count as noise; where it is not and follows `sizes`
/// (uneven_scatter.h), the row counts among those of like size. Nothing of fewer than eight rows, or without
/// derivatives.
std::optional<StrayRow> stray_row(const FitResult& result, const std::vector<std::vector<double>>& records,
                                  const std::vector<double>& sizes = {});

}  // namespace pfdm
