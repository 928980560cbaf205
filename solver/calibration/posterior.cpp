#include "solver/calibration/posterior.h"

#include "physics/error.h"
#include "physics/random_numbers.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/calibration/held_parameter.h"
#include "solver/calibration/quasi_random.h"
#include "solver/calibration/residual_emulator.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double reach_of_first = 3.5;  // of the first points, in standard errors
constexpr double beyond = 1.2;          // how much farther than the points the emulator is believed

class Sampler {
 public:
  Sampler(const FitProblem& problem, const FitResult& result, const PosteriorSettings& how)
      : problem_(problem), how_(how), random_(how.seed), emulator_(std::ssize(problem.parameters)) {
    const Eigen::LLT<MatrixXd> factor(result.covariance);
    const auto k = std::ssize(problem.parameters);
    if (result.covariance.rows() != k || !result.covariance.allFinite() || factor.info() != Eigen::Success)
      throw NoConvergence(
          "the data do not determine all parameters, or one is at a bound: there is no posterior of all");
    axes_ = factor.matrixL();
    centre_ = VectorXd(k);
    for (Eigen::Index j = 0; j < k; ++j) centre_[j] = in_fit(j, result.estimates[j].value);
    const auto n_residuals = static_cast<double>(result.residuals.size());
    noise_ = {.is_known = problem.noise_is_known,
              .freedom = std::max(1.0, n_residuals - static_cast<double>(k)),
              .n_parameters = static_cast<double>(k),
              .widening = how.widening};
    variance_ = problem.noise_is_known ? 1.0 : result.sum_of_squares / noise_.freedom;
    if (how.places)
      begin_with_discrepancy(result);
    else
      likelihood_ = std::make_unique<IndependentResiduals>(noise_);
  }

  Posterior sample() {
    run(first_points());
    for (int batch = 1;; ++batch) {
      emulator_.fit(variance_);
      likelihood_->emulate(emulator_.coefficients(), emulator_.variances());
      walk();
      found_.emulator_error = error_of_logarithm();
      const bool is_enough = found_.emulator_error < how_.enough && !found_.is_cut;
      if (is_enough || batch >= how_.most_batches) break;
      run(drawn_points());
    }
    found_.samples.reserve(chain_.size());
    for (const VectorXd& z : chain_) found_.samples.push_back(values_at(z));
    if (discrepancy_ != nullptr) found_.discrepancy = discrepancy_of_model();
    return found_;
  }

 private:
  // With a discrepancy the data say less: points lie farther apart, about other estimates.
  void begin_with_discrepancy(const FitResult& result) {
    noise_.widening = 1.0;
    auto likelihood = std::make_unique<ResidualsWithDiscrepancy>(noise_, *how_.places);
    const VectorXd residuals = VectorXd::Map(result.residuals.data(), std::ssize(result.residuals));
    VectorXd prior = VectorXd::Zero(centre_.size());
    for (Eigen::Index j = 0; j < prior.size(); ++j)
      if (const auto& of = problem_.parameters[j].prior) prior[j] = variance_ * std::pow(of->standard_deviation, -2);
    const ResidualsWithDiscrepancy::Linear linear = likelihood->linear(residuals, result.derivatives, prior);
    axes_ = Eigen::LLT<MatrixXd>(linear.covariance).matrixL();
    variance_ = linear.variance;
    constexpr double kept = 0.01;  // of the estimate's distance from a bound
    for (Eigen::Index j = 0; j < centre_.size(); ++j) {
      const double at = kept * centre_[j], moved = centre_[j] + linear.change[j];
      centre_[j] = std::clamp(moved, at + (1.0 - kept) * in_fit(j, problem_.parameters[j].lower),
                              at + (1.0 - kept) * in_fit(j, problem_.parameters[j].upper));
    }
    discrepancy_ = likelihood.get();
    likelihood_ = std::move(likelihood);
  }
  ModelDiscrepancy discrepancy_of_model() const {
    constexpr std::size_t most = 400;
    std::vector<VectorXd> phis;
    const std::size_t n = std::min(most, chain_.size());
    for (std::size_t i = 0; i < n; ++i) phis.push_back(emulator_.monomials_at(chain_[i * chain_.size() / n]));
    return discrepancy_->found(phis, how_.seed);
  }

  std::size_t n_in_batch() const {
    const auto k = problem_.parameters.size();
    return (k + 1) * (k + 2);  // twice the coefficients of a polynomial of second degree
  }

  double in_fit(Eigen::Index j, double value) const {
    return problem_.parameters[j].log_scale ? std::log(value) : value;
  }
  std::vector<double> values_at(const VectorXd& z) const {
    const VectorXd x = centre_ + axes_ * z;
    std::vector<double> values(problem_.parameters.size());
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] = problem_.parameters[j].log_scale ? std::exp(x[j]) : x[j];
    return values;
  }
  bool is_within_bounds(const std::vector<double>& values) const {
    for (std::size_t j = 0; j < values.size(); ++j)
      if (values[j] < problem_.parameters[j].lower || values[j] > problem_.parameters[j].upper) return false;
    return true;
  }

  // Normally distributed, evenly: Halton's points, each with the one opposite. Along each axis the farthest ones are as
  // far as the posterior goes if the model is linear.
  std::vector<VectorXd> first_points() const {
    std::vector<VectorXd> points{VectorXd::Zero(centre_.size())};
    const std::vector<int> bases = primes(problem_.parameters.size());
    VectorXd most = VectorXd::Constant(centre_.size(), 1e-300);
    for (int n = 2; points.size() < n_in_batch(); ++n) {  // the first one is the middle of an axis
      VectorXd z(centre_.size());
      for (Eigen::Index j = 0; j < z.size(); ++j)
        z[j] = std::numbers::sqrt2 * boost::math::erf_inv(2.0 * radical_inverse(n, bases[j]) - 1.0);
      most = most.cwiseMax(z.cwiseAbs());
      points.push_back(z);
      points.emplace_back(-z);
    }
    const double w = noise_.widening;
    const double tails = noise_.is_known ? 1.0 : student_95(std::max(1.0, noise_.freedom / (w * w))) / student_95(1e9);
    for (VectorXd& z : points) z = within_bounds(reach_of_first * w * tails * z.cwiseQuotient(most));
    return points;
  }
  // Farther out where that would go on.
  std::vector<VectorXd> drawn_points() {
    constexpr double farther = 1.3;
    std::vector<VectorXd> points;
    for (std::size_t i = 0; i < n_in_batch(); ++i) {
      const VectorXd& z = chain_[static_cast<std::size_t>(random_.uniform() * static_cast<double>(chain_.size()))];
      points.push_back(within_bounds(found_.is_cut ? farther * z : z));
    }
    return points;
  }
  // The nearest place, in standard errors, at which no parameter is beyond a bound or on it: one parameter after the
  // other comes back, and those with which it is correlated follow.
  VectorXd within_bounds(VectorXd z) const {
    constexpr double inside = 0.99;  // of the way from the estimate to the bound
    constexpr int most_turns = 50;
    for (int turn = 0; turn < most_turns && !is_within_bounds(values_at(z)); ++turn)
      for (Eigen::Index j = 0; j < z.size(); ++j) {
        const double moved = axes_.row(j).dot(z);
        const double due = std::clamp(moved, inside * (in_fit(j, problem_.parameters[j].lower) - centre_[j]),
                                      inside * (in_fit(j, problem_.parameters[j].upper) - centre_[j]));
        z += (due - moved) / axes_.row(j).squaredNorm() * axes_.row(j).transpose();
      }
    while (!is_within_bounds(values_at(z)) && z.norm() > 1e-6) z *= 0.7;
    return z;
  }

  void run(const std::vector<VectorXd>& points) {
    if (how_.running) how_.running(static_cast<int>(points.size()));
    std::vector<std::vector<double>> values;
    values.reserve(points.size());
    for (const VectorXd& z : points) values.push_back(values_at(z));
    if (problem_.prepare) problem_.prepare(values);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ++found_.evaluations;
      if (const auto residuals = problem_.residuals(values[i]))
        emulator_.add(points[i], *residuals);
      else
        ++found_.failures;
    }
    if (3 * found_.failures > found_.evaluations)
      throw NoConvergence(fmt::format("the posterior: the model converges at {} of {} points about the estimates",
                                      emulator_.n_points(), found_.evaluations));
    reach_ = beyond * emulator_.reach();
  }

  double logarithm(const VectorXd& z) const {
    constexpr double none = -std::numeric_limits<double>::infinity();
    if ((z.array().abs() > reach_.array()).any()) return none;
    const std::vector<double> values = values_at(z);
    if (!is_within_bounds(values)) return none;
    double sum = likelihood_->logarithm_at(emulator_.monomials_at(z));
    for (std::size_t j = 0; j < values.size(); ++j) sum -= 0.5 * prior_term(problem_.parameters[j], values[j]);
    return sum;
  }

  // Of the points that are within some standard errors: differences count, not a constant.
  double error_of_logarithm() const {
    constexpr double far = 8.0;  // below the largest logarithm
    std::vector<double> given, errors;
    for (Eigen::Index i = 0; i < emulator_.given().rows(); ++i) {
      given.push_back(likelihood_->logarithm_of(emulator_.given().row(i)));
      errors.push_back(likelihood_->logarithm_of(emulator_.left_out().row(i)) - given.back());
    }
    const double best = std::ranges::max(given);
    double n = 0.0, sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (given[i] < best - far) continue;
      n += 1.0, sum += errors[i], squares += errors[i] * errors[i];
    }
    if (2.0 * n < static_cast<double>(n_in_batch())) return std::numeric_limits<double>::infinity();  // too few to tell
    return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
  }

  struct Walker {
    VectorXd z;
    double logarithm;
  };

  std::vector<Walker> start(std::size_t n) {
    std::vector<Walker> walkers;
    constexpr int most_tried = 1000;
    for (std::size_t i = 0; i < n; ++i) {
      VectorXd z(centre_.size());
      bool is_possible = false;
      for (int tried = 0; tried < most_tried && !is_possible; ++tried) {
        const double nearer = std::pow(0.9, tried / 10);  // where bounds are narrow
        for (double& entry : z) entry = nearer * random_.normal();
        is_possible = std::isfinite(logarithm(z));
      }
      if (!is_possible) z.setZero();
      walkers.push_back({z, logarithm(z)});
    }
    return walkers;
  }

  // One half of the walkers after the other, each along the line to one of the other half.
  void step(std::vector<Walker>& walkers) {
    const std::size_t half = walkers.size() / 2;
    const auto dimension = static_cast<double>(centre_.size());
    for (std::size_t i = 0; i < walkers.size(); ++i) {
      const std::size_t other =
          (i < half ? half : 0) + static_cast<std::size_t>(random_.uniform() * static_cast<double>(half));
      const double stretch = std::pow(1.0 + random_.uniform(), 2) / 2.0;
      const VectorXd z = walkers[other].z + stretch * (walkers[i].z - walkers[other].z);
      const double at = logarithm(z);
      if (std::log(1.0 - random_.uniform()) < (dimension - 1.0) * std::log(stretch) + at - walkers[i].logarithm)
        walkers[i] = {z, at};
    }
  }

  void walk() {
    constexpr int warm_up = 400;
    const std::size_t n_walkers = std::max<std::size_t>(40, 4 * problem_.parameters.size());
    const std::size_t kept_of_each = (static_cast<std::size_t>(how_.samples) + n_walkers - 1) / n_walkers;
    std::vector<Walker> walkers = start(n_walkers);
    for (int i = 0; i < warm_up; ++i) step(walkers);
    chain_.clear();
    constexpr int apart = 25;  // steps between samples
    for (std::size_t kept = 0; kept < kept_of_each; ++kept) {
      for (int i = 0; i < apart; ++i) step(walkers);
      for (const Walker& w : walkers) chain_.push_back(w.z);
    }
    std::size_t edge = 0;
    for (const VectorXd& z : chain_) edge += (z.array().abs() > 0.95 * reach_.array()).any() ? 1 : 0;
    found_.is_cut = static_cast<double>(edge) > 0.01 * static_cast<double>(chain_.size());
    found_.effective = effective_number(chain_);
  }

  const FitProblem& problem_;
  const PosteriorSettings& how_;
  RandomNumbers random_;
  MatrixXd axes_;            // of the linear interval's ellipsoid, a standard error long
  VectorXd centre_, reach_;  // in what is fitted; of the emulator, along the axes
  ResidualNoise noise_;
  double variance_ = 1.0;  // of the noise
  std::unique_ptr<ResidualLikelihood> likelihood_;
  const ResidualsWithDiscrepancy* discrepancy_ = nullptr;  // the likelihood, where the model may have one
  ResidualEmulator emulator_;
  std::vector<VectorXd> chain_;
  Posterior found_;
};

}  // namespace

std::vector<double> Posterior::of_parameter(std::size_t k) const {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const std::vector<double>& sample : samples) values.push_back(sample[k]);
  return values;
}

double Posterior::quantile(std::size_t k, double share) const { return pfdm::quantile(of_parameter(k), share); }

Posterior posterior(const FitProblem& problem, const FitResult& result, const PosteriorSettings& how) {
  return Sampler(problem, result, how).sample();
}

}  // namespace pfdm
