#include "solver/calibration/held_parameter.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

double prior_term(const FitParameter& p, double value) {
  if (!p.prior) return 0.0;
  const double away = p.log_scale ? std::log(value / p.prior->mean) : value - p.prior->mean;
  return std::pow(away / p.prior->standard_deviation, 2);
}

std::vector<double> others_by_linear_model(const FitProblem& problem, const FitResult& result, std::size_t k,
                                           double value) {
  std::vector<double> others;
  const auto column = static_cast<Eigen::Index>(k);
  const double from = result.estimates[k].value, variance = result.covariance(column, column);
  const double away = problem.parameters[k].log_scale ? std::log(value / from) : value - from;
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    if (j == k) continue;
    const FitParameter& p = problem.parameters[j];
    const double estimate = result.estimates[j].value;
    const double move = away * result.covariance(static_cast<Eigen::Index>(j), column) / variance;
    const double there = p.log_scale ? estimate * std::exp(move) : estimate + move;
    others.push_back(std::isfinite(there) ? there : estimate);
  }
  return others;
}

FitProblem with_held(const FitProblem& problem, std::size_t k, double value, const std::vector<double>& others) {
  const auto all = [k, value](std::span<const double> rest) {
    std::vector<double> values(rest.begin(), rest.end());
    values.insert(values.begin() + k, value);
    return values;
  };
  FitProblem held = problem;
  held.parameters.erase(held.parameters.begin() + k);
  for (std::size_t j = 0; j < others.size(); ++j)
    held.parameters[j].start = std::clamp(others[j], held.parameters[j].lower, held.parameters[j].upper);
  held.residuals = [&problem, all](std::span<const double> rest) { return problem.residuals(all(rest)); };
  if (problem.averaged)
    held.averaged = [&problem, all](std::span<const double> rest) { return problem.averaged(all(rest)); };
  if (problem.jacobian)
    held.jacobian = [&problem, all, k](std::span<const double> rest) -> std::optional<Eigen::MatrixXd> {
      const auto J = problem.jacobian(all(rest));
      if (!J) return std::nullopt;
      const auto before = static_cast<Eigen::Index>(k), after = J->cols() - before - 1;
      Eigen::MatrixXd left(J->rows(), before + after);
      left << J->leftCols(before), J->rightCols(after);
      return left;
    };
  if (problem.prepare)
    held.prepare = [&problem, all](const std::vector<std::vector<double>>& points) {
      std::vector<std::vector<double>> whole;
      whole.reserve(points.size());
      for (const std::vector<double>& point : points) whole.push_back(all(point));
      problem.prepare(whole);
    };
  return held;
}

double growth_of_squares(const FitProblem& problem, const FitResult& result, std::size_t k, double value,
                         const FitResult& held) {
  const FitParameter& p = problem.parameters[k];
  return static_cast<double>(result.residuals.size()) *
             (std::pow(held.path.back().rms, 2) - std::pow(result.path.back().rms, 2)) +
         prior_term(p, value) - prior_term(p, result.estimates[k].value);
}

}  // namespace pfdm
