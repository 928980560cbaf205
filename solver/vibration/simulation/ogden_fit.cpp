#include "solver/vibration/simulation/ogden_fit.h"

#include "physics/error.h"
#include "solver/calibration/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace pfdm {
namespace {

constexpr int n_points = 201;
constexpr double largest_alpha = 200.0;

/// Stretches and the nominal stresses that the polynomial asks for there, over the largest of them.
struct Target {
  std::vector<double> stretch;
  Eigen::VectorXd stress;
  double scale = 1.0;  // [Pa]
};

Target target_of(std::span<const double> stiffness, double length, double area, double largest_displacement) {
  Target target{.stretch = {}, .stress = Eigen::VectorXd(n_points)};
  for (int i = 0; i < n_points; ++i) {
    const double z = largest_displacement * (2.0 * i / (n_points - 1) - 1.0);
    double force = 0.0;
    for (std::size_t k = stiffness.size(); k-- > 0;) force = (force + stiffness[k]) * z;
    target.stretch.push_back(1.0 + z / length);
    target.stress[i] = force / area;
  }
  target.scale = target.stress.lpNorm<Eigen::Infinity>();
  target.stress /= target.scale;
  return target;
}

/// Weights mu alpha >= 0 of terms with these exponents, over the target's scale, and what they leave.
struct Weighted {
  Eigen::VectorXd weights;
  Eigen::VectorXd residual;
};

/// The stress of a term over mu alpha, which has a limit for alpha = 0.
double basis(double alpha, double stretch) {
  if (std::abs(alpha) < 1e-6) return 1.5 * std::log(stretch) / stretch;
  const OgdenTerm term{1.0 / alpha, alpha};
  return nominal_stress({&term, 1}, stretch);
}

Weighted weighted(const Target& target, std::span<const double> alphas) {
  Eigen::MatrixXd columns(n_points, std::ssize(alphas));
  for (int j = 0; j < columns.cols(); ++j)
    for (int i = 0; i < n_points; ++i) columns(i, j) = basis(alphas[j], target.stretch[i]);
  Weighted result{.weights = non_negative_least_squares(columns, target.stress), .residual = {}};
  result.residual = columns * result.weights - target.stress;
  return result;
}

/// The best of all choices from a coarse list.
std::vector<double> coarse_alphas(const Target& target, int n_terms) {
  constexpr double candidates[] = {-128, -64, -32, -16, -8, -4, -2, -1, 1, 2, 4, 8, 16, 32, 64, 128};
  constexpr int n = std::size(candidates);
  std::vector<int> choice(n_terms, 0);
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  const auto next = [&] {
    std::size_t digit = 0;
    while (digit < choice.size() && ++choice[digit] == n) choice[digit++] = 0;
    return digit < choice.size();
  };
  do {
    if (std::ranges::adjacent_find(choice, std::ranges::greater_equal()) != choice.end()) continue;  // rising only
    std::vector<double> alphas;
    alphas.reserve(choice.size());
    for (const int i : choice) alphas.push_back(candidates[i]);
    const double misfit = weighted(target, alphas).residual.norm();
    if (misfit < least * (1.0 - 1e-9)) least = misfit, best = alphas;
  } while (next());
  return best;
}

std::vector<double> refined_alphas(const Target& target, std::vector<double> alphas) {
  FitProblem problem;
  for (std::size_t j = 0; j < alphas.size(); ++j)
    problem.parameters.push_back({.name = fmt::format("alpha_{}", j + 1),
                                  .unit = "1",
                                  .first = alphas[j],
                                  .lower = -largest_alpha,
                                  .upper = largest_alpha});
  problem.residuals = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
    const Eigen::VectorXd residual = weighted(target, p).residual;
    return std::vector<double>(residual.begin(), residual.end());
  };
  std::vector<double> refined = fit(problem, {.maximum_iterations = 200, .side_by_side = false}).values();
  const bool better = weighted(target, refined).residual.norm() < weighted(target, alphas).residual.norm();
  return better ? refined : alphas;
}

}  // namespace

OgdenFit fit_ogden(std::span<const double> stiffness, double length, double area, double largest_displacement,
                   int n_terms) {
  if (!(largest_displacement > 0.0 && largest_displacement < length))
    throw InputError(
        fmt::format("a sample of {:.4g} m cannot be compressed by {:.4g} m", length, largest_displacement));
  const Target target = target_of(stiffness, length, area, largest_displacement);
  const std::vector<double> alphas = refined_alphas(target, coarse_alphas(target, n_terms));
  const Weighted found = weighted(target, alphas);
  OgdenFit result{.terms = {},
                  .largest_displacement = largest_displacement,
                  .relative_misfit = found.residual.norm() / target.stress.norm()};
  for (std::size_t j = 0; j < alphas.size(); ++j)
    if (const double weight = found.weights[j]; weight > 0.0)
      result.terms.push_back({target.scale * weight / alphas[j], alphas[j]});
  if (result.terms.empty()) throw InputError("no stable material has this stiffness polynomial");
  return result;
}

}  // namespace pfdm
