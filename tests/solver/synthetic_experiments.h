#pragma once
// Experiments made with the law itself, with or without noise.

#include <numbers>
#include <random>

#include "solver/point/endochronic_fit.h"
#include "tests/physics/endochronic_laws.h"
#include "tests/solver/loadings.h"

namespace pfdm {

/// What the channels of a loading measure, stresses or strains, with normal noise added.
inline MaterialExperiment measured(const EndochronicLaw& law, const LoadSegment& loading,
                                   const std::vector<int>& components, double noise, unsigned seed,
                                   bool follows_stress = false) {
  MaterialExperiment experiment{
      .name = "synthetic", .loading = loading, .channels = {}, .follows_stress = follows_stress};
  for (const int k : components) experiment.channels.push_back({.component = k, .values = {}, .noise = 0.0});
  const auto stresses = respond(law, experiment);
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (std::size_t c = 0; c < components.size(); ++c) {
    experiment.channels[c].values = stresses.value()[c];
    experiment.channels[c].noise = noise;
    for (double& sigma : experiment.channels[c].values) sigma += noise * normal(engine);
  }
  return experiment;
}

/// Triangles of +-0.6 % in tension, 8 cycles of 1 s, 661 points: those of the numerical studies of the calibration.
inline LoadSegment eight_cycles(int points = 661) {
  const Path triangle = [](double t) {
    const double phase = t + 0.25;
    return 0.006 * (1.0 - std::abs(4.0 * (phase - std::floor(phase)) - 2.0));
  };
  return tension_path(triangle, points - 1, 8.0);
}

}  // namespace pfdm
