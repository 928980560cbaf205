#pragma once
// Force over elongation of a bar with a cohesive crack, with noise that is not white: of fits whose intervals are known
// to be right or wrong. SYNTHETIC.

#include "solver/calibration/calibration.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace pfdm::noisy_bar {

/// Modulus, strength, toughness; cases/bar_fit.
inline const std::vector<double> truth{32e9, 2.8e6, 110.0};
constexpr double area = 8e-6, length = 0.2, range = 72e-6;

/// Linear softening [N].
inline double force(double u, double E, double ft, double Gc) {
  const double wc = 2.0 * Gc / ft, at_peak = ft * length / E;
  if (u <= at_peak) return area * E * u / length;
  return area * std::max(0.0, (wc - u) / (wc / ft - length / E));
}

/// First-order autoregression of unit variance.
inline std::vector<double> autoregression(std::size_t n, double neighbours, std::mt19937_64& engine) {
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    const double fresh = normal(engine);
    values.push_back(i == 0 ? fresh : neighbours * values.back() + std::sqrt(1.0 - neighbours * neighbours) * fresh);
  }
  return values;
}

/// Of unit variance. "white"; "ar 0.6"; "slow": a fifth of the variance with neighbours correlated by 0.9, the rest
/// white; "steps": half of it a saw of twelve teeth, as of load steps, at a random place; "mesh": half of it waves of 3
/// to 10 periods over the curve, as a coarse mesh leaves them.
inline std::vector<double> noise(const std::string& kind, std::size_t n, std::mt19937_64& engine) {
  if (kind.starts_with("ar ")) return autoregression(n, std::stod(kind.substr(3)), engine);
  std::vector<double> values = autoregression(n, 0.0, engine);
  if (kind == "white") return values;
  const double part = kind == "slow" ? 0.2 : 0.5;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> slow(n, 0.0);
  if (kind == "slow") slow = autoregression(n, 0.9, engine);
  const double place = uniform(engine);
  for (std::size_t i = 0; i < n && kind == "steps"; ++i) {
    const double teeth = 12.0 * static_cast<double>(i) / static_cast<double>(n) + place;
    slow[i] = std::sqrt(12.0) * (teeth - std::floor(teeth) - 0.5);
  }
  for (int wave = 0; wave < 6 && kind == "mesh"; ++wave) {
    const double periods = 3.0 + 7.0 * uniform(engine), phase = uniform(engine), size = normal(engine) / std::sqrt(3.0);
    for (std::size_t i = 0; i < n; ++i)
      slow[i] +=
          size * std::cos(2.0 * std::numbers::pi * (periods * static_cast<double>(i) / static_cast<double>(n) + phase));
  }
  for (std::size_t i = 0; i < n; ++i) values[i] = std::sqrt(1.0 - part) * values[i] + std::sqrt(part) * slow[i];
  return values;
}

/// The three values from n points with noise of 2 % of the largest force, whose size is not stated.
inline FitProblem problem(const std::vector<double>& noise) {
  const double scale = area * truth[1], deviation = 0.02;
  std::vector<double> u, measured;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    u.push_back(range * static_cast<double>(i) / static_cast<double>(noise.size() - 1));
    measured.push_back(force(u[i], truth[0], truth[1], truth[2]) / scale + deviation * noise[i]);
  }
  FitProblem problem;
  problem.parameters = {
      {.name = "E", .unit = "Pa", .first = 30e9, .lower = 10e9, .upper = 90e9, .log_scale = true},
      {.name = "ft", .unit = "Pa", .first = 3e6, .lower = 1e6, .upper = 9e6, .log_scale = true},
      {.name = "Gc", .unit = "J/m^2", .first = 120.0, .lower = 40.0, .upper = 400.0, .log_scale = true}};
  problem.residuals = [u, measured, scale](std::span<const double> p) -> std::optional<std::vector<double>> {
    std::vector<double> residuals;
    for (std::size_t i = 0; i < u.size(); ++i) residuals.push_back(force(u[i], p[0], p[1], p[2]) / scale - measured[i]);
    return residuals;
  };
  return problem;
}

}  // namespace pfdm::noisy_bar
