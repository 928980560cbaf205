#pragma once
// Least squares: the parameters of any model with which it meets data. The model is a function from parameters to
// residuals; the estimates come with confidence intervals, correlations, and the names of parameters that the data
// do not determine.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pfdm {

struct GaussianPrior {
  double mean = 0.0;                ///< as the parameter; of its logarithm's exponential on a logarithmic scale
  double standard_deviation = 1.0;  ///< as the parameter; of its logarithm on a logarithmic scale
};

struct FitParameter {
  std::string name;
  std::string unit;
  double first = 1.0;  ///< first guess, which also scales the parameter
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool log_scale = false;  ///< of a positive parameter: its logarithm is estimated
  std::optional<GaussianPrior> prior = std::nullopt;
  std::optional<double> start = std::nullopt;  ///< where the fit starts, if not from the first guess
  bool is_sampled = true;                      ///< other starts have other values of it
};

/// Gives the parameters that stand among the limits, by name, their bounds and prior; first guesses come to lie within.
void set_limits(std::vector<FitParameter>& parameters, const std::vector<FitParameter>& limits);

/// Residuals at these parameters, always as many; nothing where the model does not converge.
using Residuals = std::function<std::optional<std::vector<double>>(std::span<const double> parameters)>;
/// d residual_i / d parameter_j; nothing where the model does not converge.
using ResidualJacobian = std::function<std::optional<Eigen::MatrixXd>(std::span<const double> parameters)>;

/// `shared`: central about the nearest point of a grid, whose spacing is the step and which holds the first guess.
/// Points near each other have them in common, also in fits to other data; they are a half step off at most. Intervals,
/// and steps that remain at the end, are by central ones about the estimates (FitSettings::ends_on_grid).
enum class Differences { central, forward, shared };

struct FitProblem {
  std::vector<FitParameter> parameters;
  Residuals residuals;
  ResidualJacobian jacobian = {};  ///< by differences if there is none
  /// Residuals whose differences are taken in place of those of `residuals`, which are ragged: of a curve that jumps,
  /// its means over the spacing of the data.
  Residuals averaged = {};
  /// Told the points at which `residuals` will be asked for next, so that a model can compute them side by side.
  std::function<void(const std::vector<std::vector<double>>& points)> prepare = {};
  /// The residuals are divided by the standard deviation of their noise. Otherwise that is estimated from their rms.
  /// Priors need it.
  bool noise_is_known = false;
};

struct FitIteration {
  double rms = 0.0;  ///< of the residuals
  std::vector<double> parameters;
};

struct FitSettings {
  int maximum_iterations = 100;
  double tolerance = 1e-12;       ///< relative change of the parameters
  double cost_tolerance = 1e-16;  ///< relative change of the sum of squares
  double least_step = 0.0;        ///< in scaled parameters: a shorter step ends the fit
  double trust_radius = 1e4;      ///< of the first step; small for models whose failures are expensive
  Differences differences = Differences::central;
  double step = 6e-6;  ///< of the differences, in parameters over their first guess (or of the logarithm)
  double exactness =
      1e-7;  ///< of the derivatives, relative: parameters whose effects differ by less are not told apart
  bool ends_on_grid = false;  ///< with shared differences: no others at the end, where nobody asks for intervals
  bool side_by_side = true;   ///< evaluations on all threads; not for models that use threads or processes themselves
  int starts = 1;             ///< more than one: the others at random within the bounds
  double spread = 1.0;        ///< of other starts about the first one, factor exp(+-spread), where there are no bounds
  /// More than 0: instead of random starts so many points are evaluated once, the better third takes one step each, and
  /// the best `starts` of where those lead go on to the end. The points do not depend on the data, but for parameters
  /// that are not sampled, whose start is rounded so that similar fits have them in common: to `least_step`, or with
  /// shared differences to their grid, on which all points then lie.
  int screened = 0;
  std::uint64_t seed = 1;
  double robust_scale = 0.0;  ///< residuals well above count less (Huber); 0: least squares
  std::function<void(const FitIteration&)> iterated = {};  ///< after every step that was taken
};

/// The same settings for one descent, from the start of the parameters.
inline FitSettings from_one_start(FitSettings settings) {
  settings.starts = 1;
  settings.screened = 0;
  return settings;
}

/// Likewise, with shared differences to the end, of a fit whose intervals nobody asks for.
inline FitSettings on_grid(FitSettings settings) {
  settings.ends_on_grid = true;
  return settings;
}

struct FitEstimate {
  double value = 0.0;
  double standard_error = 0.0;  ///< infinite if the data do not determine the parameter
  double lower_95 = 0.0, upper_95 = 0.0;
  bool at_bound = false;
};

struct FitResult {
  bool converged = false;
  std::string message;  ///< what ended the fit
  std::vector<FitEstimate> estimates;
  Eigen::MatrixXd covariance;   ///< of the parameters, of their logarithms on a logarithmic scale
  Eigen::MatrixXd correlation;  ///< likewise
  /// d residual_i / d parameter_j, without priors (n, k), and (J^T J + priors)^-1 (k, k), zero for what the data do not
  /// determine; of the parameters' logarithms on a logarithmic scale.
  Eigen::MatrixXd derivatives, inverse_normal;
  std::vector<std::string> warnings;
  std::vector<FitIteration> path;      ///< of the best start
  std::vector<FitIteration> screened;  ///< points, in the order of the sample; rms infinite where there is no answer
  std::vector<double> residuals;       ///< at the estimates, without priors
  double rms = 0.0;                    ///< of the residuals
  double sum_of_squares = 0.0;         ///< of the residuals
  /// What each start came to; rms infinite where the model did not converge.
  std::vector<FitIteration> starts;
  int evaluations = 0;          ///< of the model
  bool noise_is_known = false;  ///< as in the problem

  std::vector<double> values() const;
};

/// Throws InputError if the problem makes no sense (first guess out of bounds, a prior without known noise, fewer
/// residuals than parameters), NoConvergence if the model does not converge at any start.
FitResult fit(const FitProblem& problem, const FitSettings& settings = {});

/// Bayesian information criterion of a fit with n residuals of unknown noise: n ln(sum/n) + k ln n. `negligible`: an
/// rms below which residuals are rounding, which more parameters do not improve.
double bayesian_information(double sum_of_squares, std::size_t n_residuals, std::size_t n_parameters,
                            double negligible);

/// Least squares with x >= 0, for models that are linear in x (Lawson, Hanson 1974).
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace pfdm
