#pragma once
// The posterior of the parameters of a fit, by Markov chains on an emulator of the residuals.
//
// Noise is normal, the prior uniform in the parameters, in their logarithms on a logarithmic scale, within the bounds,
// times the Gaussian priors of the problem. Where the noise is not known, its standard deviation s has the prior 1/s
// and is integrated over: then the posterior is proportional to S^(-n/2), S the sum of squares of n residuals.
//
// Each residual is a polynomial of second degree, of third where there are enough points, in the parameters along the
// axes of the linear interval's ellipsoid. It is fitted to runs of the model at points about the estimates and, unless
// it is exact enough, to more of them that are drawn from the posterior. What the polynomials miss of points that are
// left out of the fit, one at a time, counts as noise of the residual: where a curve jumps, that is much, and the
// posterior is wide. Chains: an ensemble whose walkers stretch towards each other (Goodman, Weare,
// Commun. Appl. Math. Comput. Sci. 5 (2010) 65).
//
// Where places are given, the model may have a discrepancy, a smooth function of them (residual_likelihood.h).

#include "solver/calibration/calibration.h"
#include "solver/calibration/residual_likelihood.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace pfdm {

struct PosteriorSettings {
  /// Of the standard errors, where residuals are correlated; of all alike.
  double widening = 1.0;
  double enough = 0.03;  ///< error of the logarithm of the emulated posterior with which no more points are run
  int most_batches = 4;  ///< of points
  int samples = 4000;
  std::uint64_t seed = 1;
  std::function<void(int points)> running = {};  ///< before each batch
  std::optional<ResidualPlaces> places = {};     ///< of the residuals, where the model may have a discrepancy
};

struct Posterior {
  std::vector<std::vector<double>> samples;  ///< parameters, in the order of the problem
  double emulator_error = 0.0;  ///< rms of that of the logarithm of the posterior, at points left out of the emulator
  double effective = 0.0;       ///< number of independent samples, of the parameter that has fewest
  bool is_cut = false;          ///< it reaches to where the emulator has no points
  int evaluations = 0, failures = 0;  ///< of the model; points at which it does not converge, and which do not count
  std::optional<ModelDiscrepancy> discrepancy = {};  ///< where the model may have one

  std::vector<double> of_parameter(std::size_t k) const;  ///< its samples
  double quantile(std::size_t k, double share) const;     ///< of these
};

/// Of a fit that determines all its parameters within their bounds. Throws NoConvergence where it does not, or where
/// the model does not converge at a third of the points.
Posterior posterior(const FitProblem& problem, const FitResult& result, const PosteriorSettings& how = {});

}  // namespace pfdm
