#pragma once
// Fits with known answers: a decay with noise, a line, and a force that softens at once.

#include "solver/calibration/calibration.h"
#include "solver/parallel.h"

#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace pfdm {

inline std::vector<double> abscissas(int n) {
  std::vector<double> x;
  x.reserve(n);
  for (int i = 0; i < n; ++i) x.push_back(i / (n - 1.0));
  return x;
}

inline double decay(double x, std::span<const double> p) { return p[0] * std::exp(-p[1] * x); }

/// a exp(-b x) against data of a = 3, b = 2 with noise.
inline FitProblem decay_problem(double noise, unsigned seed, int n = 50) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> data;
  const std::vector<double> x = abscissas(n), truth{3.0, 2.0};
  data.reserve(x.size());
  for (const double xi : x) data.push_back(decay(xi, truth) + noise * normal(engine));
  return {.parameters = {{.name = "a", .unit = "1", .first = 1.0}, {.name = "b", .unit = "1", .first = 5.0}},
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i) r.push_back(decay(x[i], p) - data[i]);
            return r;
          }};
}

/// y = p0 + p1 x, a linear model with known answers.
inline FitProblem line_problem(const std::vector<double>& x, const std::vector<double>& y) {
  return {.parameters = {{.name = "p0", .unit = "1", .first = 1.0}, {.name = "p1", .unit = "1", .first = 1.0}},
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i) r.push_back(p[0] + p[1] * x[i] - y[i]);
            return r;
          }};
}

/// A force that softens at once, a x exp(-(x/b)^8), with noise of a 2,000th of the peak.
inline FitProblem softening_problem(double a, double b, unsigned seed, double noise = 0.0004) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto force = [](double at, double scale, double end) { return scale * at * std::exp(-std::pow(at / end, 8)); };
  std::vector<double> x = abscissas(100), data;
  for (double& xi : x) data.push_back(force(xi *= 2.0, a, b) + noise * normal(engine));
  return {.parameters = {{.name = "a", .unit = "1", .first = 1.0, .lower = 0.1, .upper = 10.0, .log_scale = true},
                         {.name = "b", .unit = "1", .first = 1.0, .lower = 0.1, .upper = 10.0, .log_scale = true}},
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i) r.push_back((force(x[i], p[0], p[1]) - data[i]) / noise);
            return r;
          },
          .noise_is_known = true};
}

}  // namespace pfdm
