#include "postproc/cohesive/cohesive_fit.h"

#include "physics/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

constexpr std::size_t least_states = 10;
constexpr double negligible_misfit = 2e-3;  // what the discretisation leaves: of laws below it the simplest is best
constexpr double rigid = 1e-3;              // part of the largest separation below which a rise counts as rigid

/// States with the weights of the trapezoidal rule over their separation; the sum of these is one.
struct States {
  std::vector<double> separation, traction, weight;
  double strength = 0.0, energy = 0.0;
};

// Without those of a rigid rise, in which the separation is rounding: no function of it tells them apart.
States states_of(const std::vector<double>& separation, const std::vector<double>& traction) {
  States states;
  states.strength = *std::ranges::max_element(traction);
  const double highest = *std::ranges::max_element(separation);
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(traction) - traction.begin());
  for (std::size_t i = 0; i < separation.size(); ++i) {
    if (i <= peak && separation[i] < rigid * highest) continue;
    states.separation.push_back(separation[i]);
    states.traction.push_back(traction[i]);
  }
  const std::size_t n = states.separation.size();
  states.weight.assign(n, 1e-3 * highest);  // at least: a steep rise or a standstill counts too
  for (std::size_t i = 1; i < n; ++i) {
    const double step = std::abs(states.separation[i] - states.separation[i - 1]);
    states.weight[i - 1] += 0.5 * step;
    states.weight[i] += 0.5 * step;
  }
  const double sum = std::reduce(states.weight.begin(), states.weight.end());
  for (double& w : states.weight) w /= sum;
  for (std::size_t i = 1; i < separation.size(); ++i)
    states.energy += 0.5 * (traction[i] + traction[i - 1]) * (separation[i] - separation[i - 1]);
  return states;
}

double traction_of(const TractionSeparationLaw& law, double separation, std::span<const double> p) {
  return law.traction(law, separation, p[0], p[1], p.subspan(2));
}

CohesiveFit fit_law(const TractionSeparationLaw& law, const States& states) {
  CohesiveFit fitted{.law = std::string(law.name), .parameters = {}, .result = {}};
  fitted.parameters.push_back({.name = "strength",
                               .unit = "Pa",
                               .first = states.strength,
                               .lower = 0.2 * states.strength,
                               .upper = 5.0 * states.strength});
  fitted.parameters.push_back({.name = "fracture_energy",
                               .unit = "J/m^2",
                               .first = states.energy,
                               .lower = 0.2 * states.energy,
                               .upper = 5.0 * states.energy});
  for (const ShapeParameter& s : law.shape)
    fitted.parameters.push_back(
        {.name = std::string(s.name), .unit = "1", .first = s.first, .lower = s.lower, .upper = s.upper});
  const std::size_t n = states.traction.size();
  FitProblem problem{.parameters = fitted.parameters, .residuals = [&](std::span<const double> p) {
                       std::vector<double> r(n);
                       for (std::size_t i = 0; i < n; ++i)
                         r[i] = std::sqrt(states.weight[i] * static_cast<double>(n)) *
                                (traction_of(law, states.separation[i], p) - states.traction[i]) / states.strength;
                       return std::optional(r);
                     }};
  fitted.result = fit(problem, {.starts = 5});
  const std::vector<double> p = fitted.result.values();
  fitted.rms = std::sqrt(fitted.result.sum_of_squares / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    fitted.largest = std::max(
        fitted.largest, std::abs(traction_of(law, states.separation[i], p) - states.traction[i]) / states.strength);
  fitted.information =
      bayesian_information(fitted.result.sum_of_squares, n, fitted.parameters.size(), negligible_misfit);
  return fitted;
}

}  // namespace

std::vector<CohesiveFit> fit_laws(const std::vector<double>& separation, const std::vector<double>& traction) {
  std::vector<CohesiveFit> fits;
  if (separation.empty()) return fits;
  const States states = states_of(separation, traction);
  if (states.separation.size() < least_states || !(states.strength > 0.0 && states.energy > 0.0)) return fits;
  for (const TractionSeparationLaw& law : traction_separation_laws()) {
    try {
      fits.push_back(fit_law(law, states));
    } catch (const ComputationError&) {
      // A law that has no value anywhere near is no candidate.
    }
  }
  std::ranges::sort(fits, {}, &CohesiveFit::information);
  return fits;
}

}  // namespace pfdm
