#pragma once
// An interval taken at its word. The compliance of a set-up acts much like the modulus of the specimen, and of their
// common effect the differences of two rough curves leave something that looks like a difference: an interval that is
// too narrow. With the parameter three standard errors away, and the others estimated anew, the residuals must be as
// much larger as the interval says.

#include "cases/program/input/case_files/case_parameter.h"
#include "cases/program/session/terminal/log.h"
#include "solver/calibration/calibration.h"

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct DoneFit {
  const FitProblem& problem;
  const FitSettings& settings;
  const FitResult& result;
  const std::vector<CaseParameter>& parameters;  ///< as those of the problem
};

/// Why the data do not determine parameter k as well as its interval says: which other one makes up for it, or that the
/// model does not converge there. Nothing if they do, or if there is no interval. Takes about as many evaluations as
/// the fit.
std::optional<std::string> doubt_of_interval(const DoneFit& done, std::size_t k, Log& log);

}  // namespace pfdm
