#pragma once
// Relaxation and DMA of a known Prony series in shear, by the closed forms of a ramp that is held and of harmonic
// motion, with normal noise.

#include "solver/point/viscoelastic_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace pfdm {

inline const PronyLaw true_series{.relaxed = from_young_poisson(3e6, 0.49),
                                  .shear = {{1.5e6, 0.05}, {0.8e6, 2.0}, {0.4e6, 60.0}}};

/// Shear stress of a strain gamma that rises within T and is held [Pa].
inline double ramped(const PronyLaw& law, double gamma, double T, double t) {
  double stress = law.relaxed.mu * gamma * std::min(t / T, 1.0);
  for (const auto& [mu, tau] : law.shear)
    stress += mu * gamma * tau / T * -std::expm1(-std::min(t, T) / tau) * std::exp(-std::max(t - T, 0.0) / tau);
  return stress;
}

/// Up to `last` [s] after a ramp of 0.05 s to a shear of 5 %; noise in parts of the largest stress.
inline ViscoelasticExperiment relaxation_test(const PronyLaw& law, double noise, unsigned seed, double last = 600.0) {
  constexpr double gamma = 0.05, T = 0.05;
  ViscoelasticExperiment test{.name = "relaxation", .deformation = Deformation::shear};
  for (int i = 0; i <= 10; ++i) test.times.push_back(T * i / 10);
  for (int i = 1; i <= 150; ++i) test.times.push_back(T + 0.01 * std::pow((last - T) / 0.01, i / 150.0));
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  ViscoelasticExperiment::Channel stress{.quantity = MeasuredQuantity::stress};
  stress.noise = noise * ramped(law, gamma, T, T);
  for (const double t : test.times) {
    test.followed.push_back(gamma * std::min(t / T, 1.0));
    stress.values.push_back(ramped(law, gamma, T, t) + stress.noise * normal(engine));
  }
  test.channels = {stress};
  return test;
}

/// Storage and loss modulus from 0.01 to 100 Hz, ten to a decade, noise in parts of each value.
inline ViscoelasticExperiment frequency_sweep(const PronyLaw& law, double noise, unsigned seed) {
  ViscoelasticExperiment test{.name = "DMA", .deformation = Deformation::shear};
  ViscoelasticExperiment::Channel storage{.quantity = MeasuredQuantity::storage_modulus, .relative_noise = noise};
  ViscoelasticExperiment::Channel loss{.quantity = MeasuredQuantity::loss_modulus, .relative_noise = noise};
  std::mt19937 engine(seed + 1000000);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int i = 0; i <= 40; ++i) {
    const double w = 2.0 * std::numbers::pi * 0.01 * std::pow(10.0, 0.1 * i);
    std::complex<double> M = law.relaxed.mu;
    for (const auto& [mu, tau] : law.shear) M += mu * std::complex(0.0, w * tau) / std::complex(1.0, w * tau);
    test.angular_frequencies.push_back(w);
    storage.values.push_back(M.real() * (1.0 + noise * normal(engine)));
    loss.values.push_back(M.imag() * (1.0 + noise * normal(engine)));
  }
  test.channels = {storage, loss};
  return test;
}

}  // namespace pfdm
