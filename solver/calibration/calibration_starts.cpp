#include "solver/calibration/calibration_starts.h"

#include "physics/error.h"
#include "solver/calibration/quasi_random.h"
#include "solver/linear/dense_algebra.h"

#include <algorithm>
#include <random>

namespace pfdm {
namespace {

constexpr int trials = 4;              // of a step, each ten times as damped
constexpr double least_weight = 1e-6;  // of the damping, for parameters without influence; as Ceres'

struct Candidate {
  Eigen::VectorXd u;
  double cost = 0.0;
};

/// Where other starts may lie, about the first one.
std::pair<double, double> range_about(const ScaledModel& model, const FitSettings& settings, std::size_t j,
                                      double centre) {
  const double reach = settings.spread * (model.is_log(j) ? 1.0 : std::max(std::abs(centre), 1e-3));
  const auto [lower, upper] = model.bounds(j);
  return {std::max(lower, centre - reach), std::min(upper, centre + reach)};
}

/// `share(j)` says where in its range each parameter is.
template <class Share>
Eigen::VectorXd point_about(const ScaledModel& model, const FitSettings& settings, const Eigen::VectorXd& start,
                            const Share& share) {
  Eigen::VectorXd u = start;
  for (std::size_t j = 0; j < model.n_parameters(); ++j) {
    if (!model.problem().parameters[j].is_sampled) continue;
    double& entry = u[j];
    const auto [low, high] = range_about(model, settings, j, entry);
    entry = low + share(j) * (high - low);
  }
  return u;
}

/// The start, with what is not sampled rounded to least_step.
Eigen::VectorXd rounded_start(const ScaledModel& model, const FitSettings& settings) {
  Eigen::VectorXd u = model.start();
  const Eigen::VectorXd first = model.first();
  for (std::size_t j = 0; j < model.n_parameters(); ++j) {
    if (model.problem().parameters[j].is_sampled || !(settings.least_step > 0.0)) continue;
    const auto index = static_cast<Eigen::Index>(j);
    const double steps = std::round((u[index] - first[index]) / settings.least_step);
    const auto [lower, upper] = model.bounds(j);
    u[index] = std::clamp(first[index] + steps * settings.least_step, lower, upper);
  }
  return u;
}

/// The start, which takes the place of the first point of the sequence (in one dimension they are the same). On the
/// grid of shared differences, which are then at hand.
std::vector<Eigen::VectorXd> sample(const ScaledModel& model, const FitSettings& settings) {
  std::vector<int> bases = primes(model.n_parameters());
  for (std::size_t j = 0; j < bases.size(); ++j)  // the small ones, which fill space best, to those that are sampled
    if (!model.problem().parameters[j].is_sampled) std::rotate(bases.begin() + j, bases.end() - 1, bases.end());
  const Eigen::VectorXd start = rounded_start(model, settings);
  std::vector<Eigen::VectorXd> points;
  for (int i = 0; i < settings.screened; ++i) {
    const Eigen::VectorXd u =
        i == 0 ? start
               : point_about(model, settings, start, [&](std::size_t j) { return radical_inverse(i + 1, bases[j]); });
    const Eigen::VectorXd point = model.centre_of_differences(u);
    if (std::ranges::count(points, point) == 0) points.push_back(point);
  }
  return points;
}

void keep_best(std::vector<Candidate>& candidates, std::size_t n) {
  std::ranges::stable_sort(candidates, {}, &Candidate::cost);
  candidates.resize(std::min(n, candidates.size()));
}

/// A candidate and the linear model of its residuals.
struct Slope {
  Candidate* candidate;
  Eigen::VectorXd gradient;  // J^T r
  Eigen::MatrixXd normal;    // J^T J
};

std::vector<Slope> slopes_of(const ScaledModel& model, std::vector<Candidate>& candidates) {
  std::vector<Slope> slopes;
  for (Candidate& candidate : candidates) {
    const auto r = model.residuals(candidate.u);
    const auto J = model.jacobian(candidate.u);
    if (!r || !J) continue;
    const Eigen::Map<const Eigen::VectorXd> residuals(r->data(), static_cast<Eigen::Index>(r->size()));
    slopes.push_back({&candidate, J->transpose() * residuals, J->transpose() * *J});
  }
  return slopes;
}

/// Where a step of Levenberg and Marquardt leads, within the bounds.
Eigen::VectorXd stepped(const ScaledModel& model, const Slope& slope, double radius) {
  Eigen::MatrixXd damped = slope.normal;
  damped.diagonal() += slope.normal.diagonal().cwiseMax(least_weight) / radius;
  Eigen::VectorXd u = slope.candidate->u - solve_symmetric(damped, slope.gradient);
  for (std::size_t j = 0; j < model.n_parameters(); ++j) {
    const auto [lower, upper] = model.bounds(j);
    double& entry = u[j];
    entry = std::clamp(entry, lower, upper);
  }
  return u;
}

/// One step of each candidate, if there is one downwards; those that have none yet try again side by side.
void take_steps(const ScaledModel& model, const FitSettings& settings, std::vector<Candidate>& candidates) {
  std::vector<Slope> open = slopes_of(model, candidates);
  double radius = settings.trust_radius;
  for (int trial = 0; trial < trials && !open.empty(); ++trial, radius /= 10.0) {
    std::vector<Eigen::VectorXd> points;
    points.reserve(open.size());
    for (const Slope& slope : open) points.push_back(stepped(model, slope, radius));
    model.prepare(points);
    std::vector<Slope> still_open;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double cost = model.cost(points[i]);
      if (cost < open[i].candidate->cost)
        *open[i].candidate = {points[i], cost};
      else
        still_open.push_back(open[i]);
    }
    open = std::move(still_open);
  }
}

std::vector<Eigen::VectorXd> best_of_sample(const ScaledModel& model, const FitSettings& settings, FitResult& result) {
  const std::vector<Eigen::VectorXd> points = sample(model, settings);
  model.prepare(points);
  std::vector<Candidate> candidates;
  for (const Eigen::VectorXd& u : points) {
    candidates.push_back({u, model.cost(u)});
    result.screened.push_back({model.rms(candidates.back().cost), model.natural(u)});
  }
  std::erase_if(candidates, [](const Candidate& candidate) { return !std::isfinite(candidate.cost); });
  if (candidates.empty()) throw NoConvergence("the model converged at none of the sampled starting points");
  const auto starts = static_cast<std::size_t>(settings.starts);
  keep_best(candidates, std::max(starts, (points.size() + 2) / 3));
  take_steps(model, settings, candidates);
  keep_best(candidates, starts);
  std::vector<Eigen::VectorXd> best;
  best.reserve(candidates.size());
  for (const Candidate& candidate : candidates) best.push_back(candidate.u);
  return best;
}

}  // namespace

std::vector<Eigen::VectorXd> starting_points(const ScaledModel& model, const FitSettings& settings, FitResult& result) {
  if (settings.screened > 0) return best_of_sample(model, settings, result);
  std::vector<Eigen::VectorXd> starts{model.start()};
  std::mt19937_64 engine(settings.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 1; i < settings.starts; ++i)
    starts.push_back(point_about(model, settings, starts.front(), [&](std::size_t) { return uniform(engine); }));
  return starts;
}

}  // namespace pfdm
