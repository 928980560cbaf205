#pragma once
// Models with known parameters and records made from them, for tests of identification. All records are synthetic.
// Size of the numbers: a sample of HTPB with 50 % solids under 1.12 kg, resonance near 250 Hz.

#include "solver/vibration/identification/identification.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

namespace pfdm {

constexpr double g0 = 9.80665;  // [m/s^2]

/// Parameters of the named model of Table A2.
inline MassMaterial truth(std::string_view name) {
  const ModelStructure& s = model_structure(name);
  const double m = 1.12;
  const double omega = 2.0 * std::numbers::pi * 250.0;
  const double kk = m * omega * omega;
  const double c = 2.0 * 0.04 * m * omega;
  const double zs = 2e-4;
  MassMaterial t{.mass = m, .stiffness = {kk}, .damping = c, .reference_velocity = 0.3, .forcing = s.forcing};
  const double relative[] = {-0.05, -0.04, 0.008, 0.008};
  for (int i = 1; i < s.stiffness_order; ++i) t.stiffness.push_back(relative[i - 1] * kk / std::pow(zs, i));
  if (s.nonlinear_damping) {
    t.damping_exponent = 1.8;
    t.damping = c / 0.72;
  }
  switch (s.forcing) {
    case KernelForcing::none: break;
    case KernelForcing::displacement: t.kernel = {{1200.0, -60.0 * kk}}; break;
    case KernelForcing::stiffness: t.kernel = {{1500.0, -150.0}}; break;
    case KernelForcing::damping: t.kernel = {{500.0, 0.05 * kk}, {3000.0, 0.1 * kk}}; break;
    case KernelForcing::velocity:
      t.kernel = {{400.0, 0.12 * kk}, {3000.0, 0.25 * kk}};
      t.stiffness[0] = 0.75 * kk;
      t.damping *= 0.5;
  }
  return t;
}

/// A sweep of `level` g0 over the resonance, simulated with half the identification's step.
inline VibrationRecord sweep_record(const MassMaterial& model, double level, double duration, double from = 100.0,
                                    double to = 420.0, double rate = 6000.0) {
  const Excitation shaker =
      swept_sine({.amplitude = level * g0, .from = from, .to = to, .duration = duration, .ramp = 0.005 * duration});
  const int substeps = 2 * substeps_for(model, rate);
  const BaseNodes nodes = nodes_of(shaker, rate, substeps);
  VibrationRecord record;
  record.name = "synthetic sweep";
  record.rate = rate;
  record.band_low = from;
  record.band_high = to;
  record.relative = simulate_batch(std::span(&model, 1), nodes).col(0);
  record.base = nodes.values(Eigen::seqN(0, nodes.n_samples(), 4 * substeps));
  return record;
}

/// Largest error of the parameters in parts of their scale: of themselves; k_i of k_1/z_s^(i-1); lambda of one.
inline double largest_error(const MassMaterial& found, const MassMaterial& t) {
  const double zs = 2e-4;
  double error = std::abs(found.damping / t.damping - 1.0);
  for (std::size_t i = 0; i < t.stiffness.size(); ++i)
    error = std::max(error, std::abs(found.stiffness[i] - t.stiffness[i]) * std::pow(zs, i) / t.stiffness[0]);
  error = std::max(error, std::abs(found.damping_exponent - t.damping_exponent));
  if (found.kernel.size() != t.kernel.size()) return 1e9;
  for (std::size_t i = 0; i < t.kernel.size(); ++i) {
    error = std::max(error, std::abs(found.kernel[i].alpha / t.kernel[i].alpha - 1.0));
    error = std::max(error, std::abs(found.kernel[i].beta / t.kernel[i].beta - 1.0));
  }
  return error;
}

/// Largest relative difference of the complex stiffness between two frequencies [Hz], at a velocity amplitude [m/s].
inline double stiffness_error(const MassMaterial& found, const MassMaterial& t, double low, double high, double v) {
  double error = 0.0;
  for (double f = low; f <= high; f *= 1.02) {
    const double omega = 2.0 * std::numbers::pi * f;
    const auto K = complex_stiffness(t, omega, v);
    error = std::max(error, std::abs(complex_stiffness(found, omega, v) - K) / std::abs(K));
  }
  return error;
}

/// Random motion from 10 to 1000 Hz.
inline VibrationRecord random_record(const MassMaterial& t, double duration, std::uint64_t seed) {
  const Excitation shaker =
      band_limited_random({.density = 0.05 * g0 * g0, .low = 10.0, .high = 1000.0, .duration = duration, .seed = seed});
  const BaseNodes nodes = nodes_of(shaker, 6000.0, 1);
  VibrationRecord r{.name = "synthetic random motion",
                    .rate = 6000.0,
                    .base = {},
                    .relative = {},
                    .band_low = 20.0,
                    .band_high = 850.0};
  r.relative = simulate_batch(std::span(&t, 1), nodes).col(0);
  r.base = nodes.values(Eigen::seqN(0, nodes.n_samples(), 4));
  return r;
}

}  // namespace pfdm
