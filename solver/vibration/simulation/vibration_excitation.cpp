#include "solver/vibration/simulation/vibration_excitation.h"

#include "solver/vibration/signals/signals_fourier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace pfdm {
namespace {
using Eigen::VectorXd;

constexpr Eigen::Index half_taps = 12;  // of the interpolation, on either side

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

/// Kaiser's window, u in [-1, 1].
double kaiser(double u) {
  constexpr double beta = 20.0;
  return std::abs(u) >= 1.0 ? 0.0
                            : std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - u * u)) / std::cyl_bessel_i(0.0, beta);
}

using Taps = std::array<double, 2 * half_taps>;

/// Weights of the samples i - 11 ... i + 12 for the value at i + shift.
Taps interpolation_taps(double shift) {
  Taps taps{};
  for (Eigen::Index k = 0; k < 2 * half_taps; ++k) {
    const double x = static_cast<double>(k - half_taps + 1) - shift;
    taps[k] = sinc(x) * kaiser(x / static_cast<double>(half_taps));
  }
  return taps;
}

double apply(const Taps& taps, const VectorXd& samples, Eigen::Index i) {
  double sum = 0.0;
  const Eigen::Index first = i - half_taps + 1;
  const Eigen::Index begin = std::max<Eigen::Index>(0, -first);
  const Eigen::Index end = std::min<Eigen::Index>(2 * half_taps, samples.size() - first);
  for (Eigen::Index k = begin; k < end; ++k) sum += taps[k] * samples[first + k];
  return sum;
}

double ramp_factor(double t, double duration, double ramp) {
  const double nearest_end = std::min(t, duration - t);
  if (nearest_end >= ramp) return 1.0;
  const double s = std::sin(0.5 * std::numbers::pi * std::max(nearest_end, 0.0) / ramp);
  return s * s;
}

/// A periodic signal on a fine grid. Between its points: Lagrange's polynomial through eight of them, with an error
/// below 1e-8 for signals that have at least 32 points in their shortest period.
class TabledSignal {
 public:
  TabledSignal(const VectorXd& samples, double rate) : n_(samples.size()), rate_(rate), padded_(samples.size() + 8) {
    for (Eigen::Index i = 0; i < padded_.size(); ++i) padded_[i] = samples[(i - before + n_) % n_];
  }

  double operator()(double t) const {
    const double x = t * rate_;
    const double floor = std::floor(x);
    const double s = x - floor;
    // Products of s - k over all points but one, from the left and from the right.
    std::array<double, 8> weight{};
    double left = 1.0;
    for (std::size_t k = 0; k < 8; ++k) {
      weight[k] = left * inverse_products[k];
      left *= s + before - static_cast<double>(k);
    }
    double right = 1.0;
    for (std::size_t k = 8; k-- > 0;) {
      weight[k] *= right;
      right *= s + before - static_cast<double>(k);
    }
    const Eigen::Index i = ((static_cast<Eigen::Index>(floor) % n_) + n_) % n_;
    double sum = 0.0;
    for (std::size_t k = 0; k < 8; ++k) sum += weight[k] * padded_[i + k];
    return sum;
  }

 private:
  static constexpr int before = 3;  // points before the place
  /// 1 over the product of k - l over l != k, k = 0 ... 7.
  static constexpr std::array<double, 8> inverse_products{-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                                          -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  Eigen::Index n_;
  double rate_;
  VectorXd padded_;
};

constexpr std::array<double, 4> lobatto() {
  constexpr double root = 4.58257569495584000659;  // sqrt 21
  return {0.0, (7.0 - root) / 14.0, 0.5, (7.0 + root) / 14.0};
}

}  // namespace

Excitation swept_sine(const SweptSine& s) {
  const double T = s.duration;
  const double ratio = std::log(s.to / s.from);
  const bool logarithmic = s.logarithmic && ratio != 0.0;
  const auto phase = [=](double t) {
    if (logarithmic) return 2.0 * std::numbers::pi * s.from * T / ratio * std::expm1(ratio * t / T);
    return 2.0 * std::numbers::pi * (s.from * t + 0.5 * (s.to - s.from) * t * t / T);
  };
  const auto frequency = [=](double t) {
    return logarithmic ? s.from * std::exp(ratio * t / T) : s.from + (s.to - s.from) * t / T;
  };
  return {.duration = T,
          .band_low = std::min(s.from, s.to),
          .band_high = std::max(s.from, s.to),
          .acceleration = [=](double t) { return s.amplitude * ramp_factor(t, T, s.ramp) * std::sin(phase(t)); },
          .frequency = frequency};
}

Excitation harmonic(double amplitude, double frequency, double duration, double ramp) {
  return swept_sine({.amplitude = amplitude, .from = frequency, .to = frequency, .duration = duration, .ramp = ramp});
}

VectorXd normal_numbers(Eigen::Index n, std::uint64_t seed) {
  // std::normal_distribution differs between libraries; Box and Muller's formula does not.
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53; };
  VectorXd x(n);
  for (Eigen::Index i = 0; i < n; i += 2) {
    const double r = std::sqrt(-2.0 * std::log(uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    x[i] = r * std::cos(angle);
    if (i + 1 < n) x[i + 1] = r * std::sin(angle);
  }
  return x;
}

Excitation band_limited_random(const BandLimitedRandom& random) {
  const double df = 1.0 / random.duration;
  const auto n = fast_length(static_cast<Eigen::Index>(std::ceil(32.0 * random.high * random.duration)));
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(n / 2 + 1);
  const auto first = static_cast<Eigen::Index>(std::ceil(random.low * random.duration - 1e-9));
  const auto last = static_cast<Eigen::Index>(std::floor(random.high * random.duration + 1e-9));
  const VectorXd normal = normal_numbers(2 * (last - first + 1), random.seed);
  // x = sum a cos + b sin with variances density df; the inverse transform divides by n and doubles.
  const double scale = 0.5 * static_cast<double>(n) * std::sqrt(random.density * df);
  for (Eigen::Index k = std::max<Eigen::Index>(first, 1); k <= last; ++k)
    spectrum[k] = scale * std::complex<double>(normal[2 * (k - first)], -normal[2 * (k - first) + 1]);
  const auto signal = std::make_shared<TabledSignal>(inverse_fourier(spectrum, n), static_cast<double>(n) * df);
  return {.duration = random.duration,
          .band_low = random.low,
          .band_high = random.high,
          .acceleration = [signal](double t) { return (*signal)(t); }};
}

Excitation sampled_excitation(const VectorXd& samples, double rate, double band_low, double band_high) {
  // Between samples: the band-limited signal on an eight times finer grid, then Lagrange's polynomial.
  constexpr Eigen::Index finer = 8;
  VectorXd fine(finer * samples.size());
  for (Eigen::Index k = 0; k < finer; ++k)
    fine(Eigen::seqN(k, samples.size(), finer)) =
        shifted_samples(samples, static_cast<double>(k) / static_cast<double>(finer));
  const auto signal = std::make_shared<TabledSignal>(fine, rate * static_cast<double>(finer));
  return {.duration = static_cast<double>(samples.size() - 1) / rate,
          .band_low = band_low,
          .band_high = band_high,
          .acceleration = [signal](double t) { return (*signal)(t); }};
}

VectorXd shifted_samples(const VectorXd& samples, double shift) {
  if (shift == 0.0) return samples;
  const Taps taps = interpolation_taps(shift);
  VectorXd result(samples.size());
  for (Eigen::Index i = 0; i < samples.size(); ++i) result[i] = apply(taps, samples, i);
  return result;
}

BaseNodes nodes_of(const Excitation& excitation, double rate, int substeps) {
  const auto n = static_cast<Eigen::Index>(std::floor(excitation.duration * rate + 1e-9)) + 1;
  BaseNodes nodes{.rate = rate, .substeps = substeps, .values = VectorXd(4 * substeps * (n - 1) + 1)};
  constexpr auto at = lobatto();
  for (Eigen::Index i = 0; i < nodes.values.size(); ++i) {
    const Eigen::Index substep = i / 4;
    const double time = (static_cast<double>(substep) + at[i % 4]) / (rate * substeps);
    nodes.values[i] = excitation.acceleration(time);
  }
  return nodes;
}

BaseNodes nodes_of(const VectorXd& samples, double rate, int substeps) {
  BaseNodes nodes{.rate = rate, .substeps = substeps, .values = VectorXd(4 * substeps * (samples.size() - 1) + 1)};
  constexpr auto at = lobatto();
  for (int sub = 0; sub < substeps; ++sub)
    for (int k = 0; k < 4; ++k) {
      const double shift = (sub + at[k]) / substeps;
      const VectorXd values = shifted_samples(samples, shift);
      for (Eigen::Index i = 0; i + 1 < samples.size(); ++i) nodes.values[4 * (substeps * i + sub) + k] = values[i];
    }
  nodes.values[nodes.values.size() - 1] = samples[samples.size() - 1];
  return nodes;
}

}  // namespace pfdm
