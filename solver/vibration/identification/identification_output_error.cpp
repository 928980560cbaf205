#include "solver/vibration/identification/identification_output_error.h"

#include "solver/calibration/levenberg_marquardt.h"
#include "solver/linear/dense_algebra.h"
#include "solver/vibration/identification/identification_base_noise.h"
#include "solver/vibration/identification/identification_coordinates.h"
#include "solver/vibration/identification/identification_intervals.h"
#include "solver/vibration/identification/identification_responses.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pfdm {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Residuals as a function of the coordinates. Remembers the last response, from which the Jacobian starts, and
/// the last Jacobian, which is asked for again where a search has ended.
class OutputError {
 public:
  /// `evaluations` counts the simulated responses to all records.
  OutputError(const Responses& responses, const ParameterCoordinates& coordinates, const Drives& drives,
              int& evaluations)
      : responses_(responses), coordinates_(coordinates), drives_(drives), evaluations_(evaluations) {}

  VectorXd residuals(const VectorXd& x) { return responses_.residuals(response(x)); }

  const MatrixXd& jacobian(const VectorXd& x) {
    if (x.size() == jacobian_at_.size() && x == jacobian_at_) return jacobian_;
    constexpr double h = 1e-6;
    std::vector<MassMaterial> moved;
    for (Eigen::Index k = 0; k < x.size(); ++k)
      moved.push_back(coordinates_.model(x + h * VectorXd::Unit(x.size(), k)));
    const MatrixXd y = simulated(moved);
    jacobian_ = (y.colwise() - response(x)) / h;
    // A neighbour with unbounded motion gives no information on this parameter.
    for (Eigen::Index k = 0; k < x.size(); ++k)
      if (!jacobian_.col(k).allFinite()) jacobian_.col(k).setZero();
    jacobian_at_ = x;
    return jacobian_;
  }

  LeastSquaresProblem problem(const VectorXd& start) {
    return {.residuals = [this](const VectorXd& x) { return std::optional(residuals(x)); },
            .jacobian = [this](const VectorXd& x) { return std::optional(jacobian(x)); },
            .bounds = coordinates_.bounds(coordinates_.model(start))};
  }

 private:
  MatrixXd simulated(std::span<const MassMaterial> models) {
    evaluations_ += static_cast<int>(models.size());
    return responses_.simulated(models, drives_);
  }

  const VectorXd& response(const VectorXd& x) {
    if (x.size() != at_.size() || x != at_) {
      const MassMaterial model = coordinates_.model(x);
      response_ = simulated(std::span(&model, 1)).col(0);
      at_ = x;
    }
    return response_;
  }

  const Responses& responses_;
  const ParameterCoordinates& coordinates_;
  const Drives& drives_;
  int& evaluations_;
  VectorXd at_;
  VectorXd response_;
  VectorXd jacobian_at_;
  MatrixXd jacobian_;
};

/// A regression may overshoot what holds the mass: softer in its nonlinear part, it starts from somewhere.
VectorXd bounded_start(OutputError& error, const ParameterCoordinates& coordinates, MassMaterial start) {
  for (int i = 0; i < 8; ++i) {
    VectorXd x = coordinates.from(start);
    if (error.residuals(x).allFinite()) return x;
    for (std::size_t k = 1; k < start.stiffness.size(); ++k) start.stiffness[k] *= i < 6 ? 0.5 : 0.0;
  }
  return coordinates.from(start);
}

/// Little damping of the first steps: terms of a kernel are nearly collinear, and a step back costs one simulation.
LeastSquaresSettings until(double tolerance) {
  return {.tolerance = tolerance, .cost_tolerance = tolerance, .trust_radius = 1e6};
}

/// Where the sum of squares is least, the residuals there, and the Jacobian there or nearby.
struct Minimum {
  VectorXd x;
  VectorXd residuals;
  MatrixXd jacobian;
  std::vector<LeastSquaresPoint> path;
  bool converged = false;
};

constexpr double gain_tolerance = 1e-10;  // of the sum of squares and of the parameters

constexpr double damping = 1e-8;  // of columns of norm one: for directions that the records do not determine

/// Gauss-Newton steps with the Jacobian of a cheaper simulation near the minimum: one simulation a step. Not converged
/// if they do not contract.
Minimum follow_fixed_jacobian(OutputError& error, VectorXd x, MatrixXd jacobian) {
  const VectorXd norms = jacobian.colwise().norm().cwiseMax(1e-300);
  const MatrixXd scaled = jacobian * norms.cwiseInverse().asDiagonal();
  MatrixXd normal = scaled.transpose() * scaled;
  normal.diagonal().array() += damping;
  Minimum best{.x = x, .residuals = error.residuals(x), .jacobian = std::move(jacobian), .path = {}};
  VectorXd r = best.residuals;
  double last_step = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 12 && r.allFinite(); ++i) {
    best.x = x;
    best.residuals = r;
    best.path.push_back({x, 0.5 * r.squaredNorm()});
    const VectorXd step = solve_symmetric(normal, scaled.transpose() * r);
    const double gain = (best.jacobian * step.cwiseQuotient(norms)).norm();
    if (gain * gain <= gain_tolerance * r.squaredNorm()) {
      best.converged = true;
      break;
    }
    if (gain > 0.5 * last_step) break;
    last_step = gain;
    x -= step.cwiseQuotient(norms);
    r = error.residuals(x);
  }
  return best;
}

Minimum minimise_fully(OutputError& error, const VectorXd& x0) {
  const LeastSquaresResult found = minimise(error.problem(x0), x0, until(gain_tolerance));
  return {.x = found.x,
          .residuals = error.residuals(found.x),
          .jacobian = error.jacobian(found.x),
          .path = found.path,
          .converged = found.converged};
}

/// Where the record with the strongest response alone has its minimum: from a start that is far off it is the cheaper
/// way. `start` if that does not bring all records nearer.
VectorXd approached_by_one(const VibrationRecord& strongest, double crop, OutputError& all,
                           const ParameterCoordinates& coordinates, const MassMaterial& start, const VectorXd& x0,
                           int most_iterations, int& evaluations) {
  constexpr double roughly = 1e-4;
  const Responses one(std::span(&strongest, 1), crop, start);
  const Drives drives = one.reduced_drives(start);
  OutputError error(one, coordinates, drives, evaluations);
  LeastSquaresSettings settings = until(roughly);
  settings.maximum_iterations = most_iterations;
  const VectorXd x = minimise(error.problem(x0), x0, settings).x;
  const double before = all.residuals(x0).squaredNorm(), after = all.residuals(x).squaredNorm();
  return after < before ? x : x0;
}

/// With as few samples as the compared band needs.
Minimum approach(std::span<const VibrationRecord> records, OutputError& coarse, const ParameterCoordinates& coordinates,
                 const MassMaterial& start, bool is_near, double crop, int most_iterations, int& evaluations,
                 double due_cost = std::numeric_limits<double>::infinity()) {
  constexpr double near = 1e-6;
  VectorXd x0 = bounded_start(coarse, coordinates, start);
  const auto strength = [](const VibrationRecord& r) { return r.relative.squaredNorm() / static_cast<double>(r.n()); };
  if (records.size() > 1 && !is_near)
    x0 = approached_by_one(*std::ranges::max_element(records, {}, strength), crop, coarse, coordinates, start, x0,
                           most_iterations, evaluations);
  LeastSquaresSettings settings = until(near);
  settings.maximum_iterations = most_iterations;
  settings.due_cost = due_cost;
  LeastSquaresResult found = minimise(coarse.problem(x0), x0, settings);
  return {.x = found.x,
          .residuals = coarse.residuals(found.x),
          .jacobian = {},
          .path = std::move(found.path),
          .converged = found.converged};
}

/// First roughly, then to the end with all samples.
Minimum least_output_error(std::span<const VibrationRecord> records, const Responses& responses,
                           const ParameterCoordinates& coordinates, const MassMaterial& start, bool is_near,
                           double crop, int& evaluations) {
  const Drives reduced = responses.reduced_drives(start);
  OutputError coarse(responses, coordinates, reduced, evaluations);
  Minimum approached = approach(records, coarse, coordinates, start, is_near, crop, 100, evaluations);
  const Drives full = responses.full_drives(coordinates.model(approached.x));
  OutputError error(responses, coordinates, full, evaluations);
  Minimum found = follow_fixed_jacobian(error, approached.x, coarse.jacobian(approached.x));
  std::vector<LeastSquaresPoint> path = std::move(approached.path);
  path.insert(path.end(), found.path.begin(), found.path.end());
  if (!found.converged) {
    found = minimise_fully(error, found.x);
    path.insert(path.end(), found.path.begin(), found.path.end());
  }
  found.path = std::move(path);
  return found;
}

/// With the terms in the order of their rates: the coordinates that belong to it.
ParameterCoordinates put_in_order(Minimum& found, const ParameterCoordinates& coordinates, MassMaterial start,
                                  const ExcitedRange& range) {
  const MassMaterial m = coordinates.model(found.x);
  const auto columns = rising_order(m, found.x.size());
  if (!columns) return coordinates;
  found.x = VectorXd(found.x(*columns));
  found.jacobian = MatrixXd(found.jacobian(Eigen::all, *columns));
  for (LeastSquaresPoint& point : found.path) point.x = VectorXd(point.x(*columns));
  start.kernel = m.kernel;  // which terms are pairs
  sort_terms(start);
  return {start, range};
}

/// All that follows from where a search has ended, but for the intervals.
OutputErrorFit fit_at(const Minimum& found, const Responses& responses, const ParameterCoordinates& coordinates,
                      int evaluations) {
  OutputErrorFit fit;
  fit.converged = found.converged;
  fit.evaluations = evaluations;
  fit.model = coordinates.model(found.x);
  fit.estimates = named_values(fit.model);
  coordinates.set_bounds(fit.model, fit.estimates);
  const double n = static_cast<double>(responses.size());
  fit.n_residuals = static_cast<std::size_t>(responses.size());
  for (const LeastSquaresPoint& point : found.path) {
    fit.path.push_back({.rms = std::sqrt(2.0 * point.cost / n), .parameters = {}});
    for (const Estimate& e : named_values(coordinates.model(point.x))) fit.path.back().parameters.push_back(e.value);
  }
  if (!found.residuals.allFinite()) return fit;
  fit.record_misfit = responses.misfits(found.residuals);
  fit.bic = n * std::log(found.residuals.squaredNorm() / n) + static_cast<double>(found.x.size()) * std::log(n);
  return fit;
}

/// Half the sum of squares at which a fit of n residuals and k parameters has this information.
double cost_of(double bic, Eigen::Index n_residuals, Eigen::Index n_parameters) {
  const double n = static_cast<double>(n_residuals), k = static_cast<double>(n_parameters);
  return 0.5 * n * std::exp((bic - k * std::log(n)) / n);
}

}  // namespace

OutputErrorFit approach_output(std::span<const VibrationRecord> records, const MassMaterial& start,
                               const IdentificationSettings& settings, std::optional<double> rival) {
  constexpr int most_iterations = 25;
  MassMaterial sorted = start;
  sort_terms(sorted);
  const Responses responses(records, settings.crop, sorted);
  const ParameterCoordinates coordinates(sorted, excited_range(records));
  const Drives reduced = responses.reduced_drives(sorted);
  int evaluations = 0;
  OutputError coarse(responses, coordinates, reduced, evaluations);
  const Minimum found =
      approach(records, coarse, coordinates, sorted, false, settings.crop, most_iterations, evaluations,
               rival ? cost_of(*rival, responses.size(), coordinates.from(sorted).size())
                     : std::numeric_limits<double>::infinity());
  return fit_at(found, responses, coordinates, evaluations);
}

OutputErrorFit refine_output(std::span<const VibrationRecord> records, const MassMaterial& start,
                             const IdentificationSettings& settings, bool is_near) {
  MassMaterial sorted = start;
  sort_terms(sorted);
  const Responses responses(records, settings.crop, sorted);
  const ExcitedRange range = excited_range(records);
  ParameterCoordinates coordinates(sorted, range);
  int evaluations = 0;
  Minimum found = least_output_error(records, responses, coordinates, sorted, is_near, settings.crop, evaluations);
  coordinates = put_in_order(found, coordinates, sorted, range);
  const bool bounded = found.residuals.allFinite();
  const auto bias = bounded
                        ? base_noise_bias(records, coordinates, found.x, found.residuals, found.jacobian, settings.crop)
                        : std::nullopt;
  if (bias) found.x -= *bias;
  OutputErrorFit fit = fit_at(found, responses, coordinates, evaluations);
  if (bounded && !bias)
    fit.doubts.emplace_back("noise on the base's acceleration biases the estimates by more than can be taken back");
  if (!fit.record_misfit.empty() && settings.replicates > 1) {
    const ParameterReplicates replicates =
        parameter_replicates(found.x, found.residuals, found.jacobian, responses.blocks(), settings.replicates,
                             settings.confidence, settings.seed);
    if (replicates.rest_on_one_block)
      fit.doubts.emplace_back(
          "one short stretch of the records alone tells of some parameter: how far its estimate scatters is not known");
    set_intervals(fit, coordinates, replicates, settings.confidence);
  }
  return fit;
}

}  // namespace pfdm
