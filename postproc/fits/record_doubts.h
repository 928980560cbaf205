#pragma once
// What the rows of the records say against a fit, the same for every kind of case: one that is stray, and scatter that
// follows the size of what was measured.

#include "postproc/fits/fit_findings.h"
#include "solver/calibration/calibration.h"

#include <functional>
#include <string>
#include <vector>

namespace pfdm {

/// A record as a fit has it; residuals of records follow one another, as the records do.
struct FittedRecord {
  std::vector<double> measured{};               ///< in the unit of the residuals
  std::vector<double> size{};                   ///< of the model, positive, in any unit that all records have in common
  std::function<std::string(std::size_t)> row;  ///< by number: "the row of pull.csv with 12.3 N at 45 um"
};

/// One more reason where a single row moves an estimate, and noise would not have left it where it is (stray_row.h).
/// Rms below `negligible`, of noise that is not known, is rounding.
void doubt_stray_row(const FitResult& result, const std::vector<FittedRecord>& records, double negligible,
                     FitFindings& found);

/// Widens the intervals of a sound fit whose noise is not known, and follows the size of what was measured
/// (uneven_scatter.h); says so with `advice`, what states such noise. Not where correlated residuals have widened them.
void widen_for_uneven_scatter(const FitResult& result, const std::vector<FittedRecord>& records, double negligible,
                              const std::string& advice, FitFindings& found);

}  // namespace pfdm
