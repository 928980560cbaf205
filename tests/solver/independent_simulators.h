#pragma once
// Records and curves from simulators that share nothing with the program's: classical Runge-Kutta steps for a mass on a
// sample, and explicit Euler steps of small size for metals under cyclic tension. All of it is synthetic.

#include "physics/point/mass_material.h"
#include "solver/point/endochronic_fit.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace pfdm::independent {

// ---- A mass on a sample

struct Sample {
  double mass = 1.12;                                 // [kg]
  std::function<double(double z, double v)> force{};  // of stiffness and damping [N]
  std::vector<std::complex<double>> alpha{}, beta{};  // v' + ... on z'; an entry with Im != 0 stands for a pair
};

/// With these parameters; its kernel acts on z'.
inline Sample sample_of(const MassMaterial& t) {
  Sample s{.mass = t.mass};
  s.force = [t](double z, double v) {
    double force = t.damping * v * std::pow(std::abs(v) / t.reference_velocity, t.damping_exponent), power = 1.0;
    for (const double k : t.stiffness) force += k * (power *= z);
    return force;
  };
  for (const HereditaryTerm& term : t.kernel) s.alpha.push_back(term.alpha), s.beta.push_back(term.beta);
  return s;
}

struct Shaker {
  double duration = 6.0, rate = 6000.0, low = 100.0, high = 420.0;  // [s], [Hz]
  double level = 100.0;                                             // amplitude or rms [m/s^2]
  bool random = false;
  unsigned seed = 1;
};

/// Base acceleration at times i h: a sweep, or sines of random phase, each turned on from one time to the next.
inline std::vector<double> base_at_times(const Shaker& s, std::size_t n, double h) {
  std::vector<double> y(n);
  const double slope = (s.high - s.low) / s.duration, ramp = 0.01 * s.duration, two_pi = 2.0 * std::numbers::pi;
  const auto envelope = [&](double t) {
    const double from_end = std::min(t, s.duration - t);
    return from_end >= ramp ? 1.0 : std::pow(std::sin(0.25 * two_pi * std::max(from_end, 0.0) / ramp), 2);
  };
  std::mt19937_64 engine(s.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int n_sines = 300, at_once = 20;  // side by side: alone each waits for its own last turn
  for (int k = 0; k < n_sines && s.random; k += at_once) {
    double real[at_once], imaginary[at_once], turn_real[at_once], turn_imaginary[at_once];
    for (int j = 0; j < at_once; ++j) {
      const double frequency = s.low + (s.high - s.low) * (k + j + uniform(engine)) / n_sines;
      const std::complex<double> turn = std::polar(1.0, two_pi * frequency * h);
      const std::complex<double> sine = std::polar(s.level * std::sqrt(2.0 / n_sines), two_pi * uniform(engine));
      real[j] = sine.real(), imaginary[j] = sine.imag(), turn_real[j] = turn.real(), turn_imaginary[j] = turn.imag();
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (const double sine : real) y[i] += sine;
      for (int j = 0; j < at_once; ++j) {
        const double turned = real[j] * turn_real[j] - imaginary[j] * turn_imaginary[j];
        imaginary[j] = real[j] * turn_imaginary[j] + imaginary[j] * turn_real[j];
        real[j] = turned;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) * h;
    if (!s.random) y[i] = s.level * std::sin(two_pi * (s.low + 0.5 * slope * t) * t);
    y[i] *= envelope(t);
  }
  return y;
}

using State = std::vector<std::complex<double>>;  // z, z', a state of each term

inline State slope(const Sample& s, const State& x, double y) {
  State d(x.size());
  const double z = x[0].real(), v = x[1].real();
  double force = s.force(z, v);
  for (std::size_t i = 0; i < s.alpha.size(); ++i) {
    force += (s.alpha[i].imag() != 0.0 ? 2.0 : 1.0) * (s.beta[i] * x[2 + i]).real();
    d[2 + i] = v - s.alpha[i] * x[2 + i];
  }
  d[0] = v;
  d[1] = -y - force / s.mass;
  return d;
}

inline State moved(const State& x, const State& d, double h) {
  State result = x;
  for (std::size_t i = 0; i < x.size(); ++i) result[i] += h * d[i];
  return result;
}

inline VibrationRecord record_of(const Sample& s, const Shaker& shaker, int substeps = 6) {
  const auto n = static_cast<Eigen::Index>(shaker.duration * shaker.rate);
  VibrationRecord r{.name = "independent", .rate = shaker.rate, .base = {}, .relative = {}};
  r.band_low = shaker.low, r.band_high = shaker.high;
  r.base.resize(n), r.relative.resize(n);
  State x(2 + s.alpha.size());
  const double h = 1.0 / (shaker.rate * substeps);
  const std::vector<double> y = base_at_times(shaker, static_cast<std::size_t>(2 * n * substeps) + 1, 0.5 * h);
  std::size_t at = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    r.base[i] = y[at];
    r.relative[i] = slope(s, x, r.base[i])[1].real();
    for (int k = 0; k < substeps; ++k, at += 2) {
      const State a = slope(s, x, y[at]), b = slope(s, moved(x, a, 0.5 * h), y[at + 1]);
      const State c = slope(s, moved(x, b, 0.5 * h), y[at + 1]), d = slope(s, moved(x, c, h), y[at + 2]);
      for (std::size_t j = 0; j < x.size(); ++j) x[j] += h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]);
    }
  }
  return r;
}

/// White noise so far below each channel's rms.
inline void add_white_noise(VibrationRecord& r, double decibel, unsigned seed, bool on_base = true) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (Eigen::VectorXd* x : {&r.relative, &r.base}) {
    if (x == &r.base && !on_base) continue;
    const double size = std::pow(10.0, -decibel / 20.0) * x->norm() / std::sqrt(static_cast<double>(x->size()));
    for (double& value : *x) value += size * normal(engine);
  }
}

// ---- Tension of metals; stress over strain at the points of a path

/// Six constants of the endochronic law in tension, without anything of the program: incompressible plastic flow,
/// sqrt(3/2) between the plastic strain's norm and its axial part.
struct EndochronicTension {
  double E = 100e9;
  std::vector<double> C{30e9, 4e9}, alpha{700.0, 60.0};
  double f_inf = 1.8, b = 9.0;
  double f(double zeta) const { return f_inf > 0.0 ? f_inf - (f_inf - 1.0) * std::exp(-b * zeta) : 1.0; }
};

/// Stress [Pa] along the strains, each interval in so many explicit midpoint steps. The axial part of a term's deviator
/// is s_r; sigma = 3/2 sum s_r.
inline std::vector<double> stress_of(const EndochronicTension& law, const std::vector<double>& strain, int steps) {
  std::vector<double> s(law.C.size(), 0.0), result{0.0};
  double plastic = 0.0, zeta = 0.0;
  const double norm = std::sqrt(1.5);
  // d sigma = E (de - dp) and d sigma = 3/2 sum (2 C dp - alpha s |dp| norm / f).
  const auto plastic_rate = [&](double direction, const std::vector<double>& at, double path) {
    double slope = 0.0;
    for (std::size_t r = 0; r < at.size(); ++r)
      slope += 1.5 * (2.0 * law.C[r] - law.alpha[r] * at[r] * direction * norm / law.f(path));
    return law.E / (law.E + slope);
  };
  for (std::size_t i = 1; i < strain.size(); ++i) {
    const double de = (strain[i] - strain[i - 1]) / steps, direction = de > 0.0 ? 1.0 : -1.0;
    for (int k = 0; k < steps; ++k) {
      const auto terms = [&](const std::vector<double>& at, double path, double dp) {
        std::vector<double> ds(at.size());
        for (std::size_t r = 0; r < at.size(); ++r)
          ds[r] = 2.0 * law.C[r] * dp - law.alpha[r] * at[r] * std::abs(dp) * norm / law.f(path);
        return ds;
      };
      const double first = 0.5 * de * plastic_rate(direction, s, zeta);
      const std::vector<double> half = terms(s, zeta, first);
      std::vector<double> middle = s;
      for (std::size_t r = 0; r < s.size(); ++r) middle[r] += half[r];
      const double path = zeta + norm * std::abs(first);
      const double dp = de * plastic_rate(direction, middle, path);
      const std::vector<double> whole = terms(middle, path, dp);
      for (std::size_t r = 0; r < s.size(); ++r) s[r] += whole[r];
      plastic += dp;
      zeta += norm * std::abs(dp);
    }
    result.push_back(law.E * (strain[i] - plastic));
  }
  return result;
}

/// Chaboche's law with one back stress and a yield surface, by its definition in small explicit steps.
inline std::vector<double> chaboche(const std::vector<double>& strain, int steps = 200) {
  const double E = 100e9, yield = 120e6, C = 30e9, gamma = 250.0;
  double plastic = 0.0, back = 0.0;
  std::vector<double> result{0.0};
  for (std::size_t i = 1; i < strain.size(); ++i) {
    const double from = strain[i - 1], to = strain[i];
    for (int k = 1; k <= steps; ++k) {
      const double sigma = E * (from + (to - from) * k / steps - plastic), over = std::abs(sigma - back) - yield;
      if (over <= 0.0) continue;
      const double direction = sigma > back ? 1.0 : -1.0;
      const double dp = over / (E + C - gamma * back * direction);
      plastic += direction * dp;
      back += direction * C * dp - gamma * back * dp;
    }
    result.push_back(E * (to - plastic));
  }
  return result;
}

/// Ramberg and Osgood's curve with Masing's rule: branches are the virgin curve, doubled, from the last reversal on.
inline std::vector<double> ramberg_osgood(const std::vector<double>& strain) {
  const double E = 100e9, K = 600e6, n = 5.0;
  const auto strain_of = [&](double s) { return s / E + std::copysign(std::pow(std::abs(s) / K, n), s); };
  const auto stress_at = [&](double e) {
    double low = -2e9, high = 2e9;
    for (int i = 0; i < 80; ++i) (strain_of(0.5 * (low + high)) < e ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  };
  std::vector<double> result{0.0};
  double e0 = 0.0, s0 = 0.0, factor = 1.0;
  for (std::size_t i = 1; i < strain.size(); ++i) {
    if (i > 1 && (strain[i] - strain[i - 1]) * (strain[i - 1] - strain[i - 2]) < 0.0)
      e0 = strain[i - 1], s0 = result.back(), factor = 2.0;
    result.push_back(s0 + factor * stress_at((strain[i] - e0) / factor));
  }
  return result;
}

/// Triangles of strain between +-amplitude.
inline std::vector<double> triangles(double amplitude, int cycles, int points_per_cycle) {
  std::vector<double> strain;
  for (int i = 0; i <= cycles * points_per_cycle; ++i) {
    const double phase = static_cast<double>(i) / points_per_cycle + 0.25;
    strain.push_back(amplitude * (1.0 - std::abs(4.0 * (phase - std::floor(phase)) - 2.0)));
  }
  return strain;
}

/// A measured tension test, with normal noise [Pa], stated or not.
inline MaterialExperiment tension_test(const std::vector<double>& strain, std::vector<double> stress, double noise,
                                       unsigned seed, bool stated = true) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (double& value : stress) value += noise * normal(engine);
  MaterialExperiment experiment{.name = "independent", .loading = {}, .channels = {}};
  for (std::size_t i = 0; i < strain.size(); ++i) experiment.loading.times.push_back(0.01 * static_cast<double>(i));
  for (int k = 0; k < 6; ++k) {
    auto& condition = experiment.loading.conditions[k];
    condition.pace = Pace::follow;
    condition.values.assign(strain.size(), 0.0);
    if (k == 0) {
      condition.condition.on_strain[0] = 1.0;
      condition.values = strain;
    } else {
      condition.condition.on_stress[k] = 1.0;
    }
  }
  experiment.channels.push_back({.component = 0, .values = std::move(stress), .noise = stated ? noise : 0.0});
  return experiment;
}

}  // namespace pfdm::independent
