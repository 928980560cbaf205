#pragma once
// Laws and random states for the tests of endochronic plasticity. The numbers are chosen, not measured on any material.

#include <cmath>
#include <random>

#include "physics/point/endochronic.h"

namespace pfdm {

/// E = 117 GPa, nu = 0.34, C = 30 GPa, alpha = 700, f = 1.
inline EndochronicLaw one_term_law() {
  return {.elasticity = from_young_poisson(117e9, 0.34), .kernel = {{30e9, 700.0}}, .hardening = {}};
}

inline Factor saturating(double f_inf, double b) { return make_factor(hardening_law("saturating"), {f_inf, b, 1.0}); }

inline Factor logarithmic_rate(double c, double reference) {
  return make_factor(rate_factor("logarithmic"), {c, reference});
}

/// Three terms that reach from the first plastic strain to per cents, f = 3 - 2 exp(-6 zeta).
inline EndochronicLaw three_term_law() {
  EndochronicLaw law = one_term_law();
  law.kernel = {{60e9, 3000.0}, {15e9, 500.0}, {2e9, 30.0}};
  law.hardening.with_path = saturating(3.0, 6.0);
  return law;
}

/// Laws, states and steps of all sizes.
class RandomEndochronic {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  /// Of norm 1.
  Mandel direction() {
    Mandel v;
    for (double& entry : v) entry = std::normal_distribution<double>()(engine_);
    return v.normalized();
  }

  /// One to five terms, every tenth with alpha = 0; a hardening or softening f, in every second law with a rate factor.
  EndochronicLaw law() {
    EndochronicLaw law;
    law.elasticity = from_young_poisson(log_uniform(1e6, 1e12), uniform(0.0, 0.49));
    const int n = static_cast<int>(uniform(1.0, 5.999));
    for (int r = 0; r < n; ++r)
      law.kernel.push_back(
          {law.elasticity.mu * log_uniform(1e-3, 10.0), uniform(0.0, 1.0) < 0.1 ? 0.0 : log_uniform(1.0, 1e5)});
    law.hardening.with_path = saturating(log_uniform(0.2, 5.0), log_uniform(0.1, 100.0));
    if (uniform(0.0, 1.0) < 0.5) law.hardening.with_rate = logarithmic_rate(uniform(0.0, 0.3), 1e-4);
    law.beta = uniform(0.0, 1.0) < 0.8 ? 0.5 : uniform(0.0, 1.0);
    return law;
  }

  /// Stresses up to saturation in directions of their own; the strains fit them.
  EndochronicState state(const EndochronicLaw& law) {
    EndochronicState state = virgin_state(law);
    state.zeta = uniform(0.0, 1.0) < 0.2 ? 0.0 : log_uniform(1e-6, 10.0);
    state.plastic_strain = 1e-2 * deviator(direction());
    Mandel sum = Mandel::Zero();
    for (std::size_t r = 0; r < law.kernel.size(); ++r) {
      const double f = law.hardening(state.zeta, 0.0).f;
      const double radius = 2.0 * law.kernel[r].C * f / std::max(law.kernel[r].alpha, 100.0);
      state.s[r] = uniform(0.0, 1.0) * radius * deviator(direction()).normalized();
      sum += state.s[r];
    }
    state.strain = state.plastic_strain + sum / (2.0 * law.elasticity.mu) + uniform(-1e-3, 1e-3) * mandel_identity();
    return state;
  }

 private:
  std::mt19937_64 engine_{19710204};
};

}  // namespace pfdm
