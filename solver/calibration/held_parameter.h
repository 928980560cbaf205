#pragma once
// A fit with one parameter held at a value: what the others make up for.

#include "solver/calibration/calibration.h"

namespace pfdm {

/// The problem of the other parameters with parameter k at `value`; they start from `others`, one each, within their
/// bounds. Keeps a reference to `problem`.
FitProblem with_held(const FitProblem& problem, std::size_t k, double value, const std::vector<double>& others);

/// Where the linear model about the estimates has the least residuals with parameter k moved to `value`: a value of
/// each of the others.
std::vector<double> others_by_linear_model(const FitProblem& problem, const FitResult& result, std::size_t k,
                                           double value);

/// What the priors add to the sum of squares of the residuals at this value of a parameter; 0 without.
double prior_term(const FitParameter& parameter, double value);

/// Growth of the sum of squares, priors included, from the estimates of `result` to those of `held`, the fit of
/// with_held() at `value`.
double growth_of_squares(const FitProblem& problem, const FitResult& result, std::size_t k, double value,
                         const FitResult& held);

}  // namespace pfdm
