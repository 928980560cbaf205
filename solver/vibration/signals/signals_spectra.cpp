#include "solver/vibration/signals/signals_spectra.h"

#include "physics/error.h"
#include "solver/vibration/signals/signals_fourier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {
using Eigen::VectorXcd;
using Eigen::VectorXd;

struct Segments {
  Eigen::Index length = 0;
  Eigen::Index step = 0;
  Eigen::Index count = 0;
  VectorXd window{};
  bool remove_mean = true;

  VectorXcd transform(const VectorXd& x, Eigen::Index i) const {
    VectorXd part = x.segment(i * step, length);
    if (remove_mean) part.array() -= part.mean();
    return fourier(part.cwiseProduct(window));
  }
};

Segments cut(Eigen::Index n, const SegmentSettings& settings) {
  if (settings.length < 2)
    throw InputError(fmt::format("segments of {} samples are too short; at least 2 are required", settings.length));
  if (!(settings.overlap >= 0.0 && settings.overlap < 1.0))
    throw InputError(fmt::format("the overlap of segments is {}; it must be at least 0 and below 1", settings.overlap));
  if (n < settings.length)
    throw InputError(fmt::format("the record has {} samples, fewer than one segment of {}", n, settings.length));
  Segments s;
  s.length = settings.length;
  s.remove_mean = settings.remove_mean;
  const auto shared = static_cast<Eigen::Index>(static_cast<double>(s.length) * settings.overlap + 1e-9);
  s.step = s.length - shared;
  s.count = (n - s.length) / s.step + 1;
  s.window = hann_window(s.length);
  return s;
}

/// Per Hz; doubled except at zero and half the rate, which have no negative twin.
VectorXd density_scale(const Segments& s, double rate) {
  VectorXd scale = VectorXd::Constant(s.length / 2 + 1, 2.0 / (rate * s.window.squaredNorm()));
  scale[0] *= 0.5;
  if (s.length % 2 == 0) scale[scale.size() - 1] *= 0.5;
  return scale;
}

VectorXd frequencies(Eigen::Index length, double rate) {
  const Eigen::Index last = length / 2;
  return VectorXd::LinSpaced(last + 1, 0.0, static_cast<double>(last)) * (rate / static_cast<double>(length));
}

/// Overlapping segments are correlated (Welch 1967, eq. 12): n/(1 + 2 sum (1 - k/n) rho_k).
double independent_averages(const Segments& s) {
  const double power = s.window.squaredNorm();
  const auto n = static_cast<double>(s.count);
  double sum = 1.0;
  for (Eigen::Index k = 1; k < s.count && k * s.step < s.length; ++k) {
    const Eigen::Index common = s.length - k * s.step;
    const double rho = s.window.head(common).dot(s.window.tail(common)) / power;
    sum += 2.0 * (1.0 - static_cast<double>(k) / n) * rho * rho;
  }
  return n / sum;
}

}  // namespace

VectorXd hann_window(Eigen::Index n) {
  VectorXd w(n);
  for (Eigen::Index i = 0; i < n; ++i)
    w[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  return w;
}

Spectra spectra(const VectorXd& x, const VectorXd& y, double rate, const SegmentSettings& settings) {
  if (x.size() != y.size())
    throw InputError(fmt::format("the signals have {} and {} samples; they must be equally long", x.size(), y.size()));
  const Segments s = cut(x.size(), settings);
  const Eigen::Index bins = s.length / 2 + 1;
  Spectra result{.frequency = frequencies(s.length, rate),
                 .Sxx = VectorXd::Zero(bins),
                 .Syy = VectorXd::Zero(bins),
                 .Sxy = VectorXcd::Zero(bins),
                 .segments = s.count,
                 .averages = independent_averages(s)};
  for (Eigen::Index i = 0; i < s.count; ++i) {
    const VectorXcd X = s.transform(x, i);
    const VectorXcd Y = s.transform(y, i);
    result.Sxx += X.cwiseAbs2();
    result.Syy += Y.cwiseAbs2();
    result.Sxy += X.conjugate().cwiseProduct(Y);
  }
  const VectorXd scale = density_scale(s, rate) / static_cast<double>(s.count);
  result.Sxx.array() *= scale.array();
  result.Syy.array() *= scale.array();
  result.Sxy.array() *= scale.array();
  return result;
}

VectorXd spectral_density(const VectorXd& x, double rate, const SegmentSettings& settings) {
  const Segments s = cut(x.size(), settings);
  VectorXd sum = VectorXd::Zero(s.length / 2 + 1);
  for (Eigen::Index i = 0; i < s.count; ++i) sum += s.transform(x, i).cwiseAbs2();
  return sum.cwiseProduct(density_scale(s, rate)) / static_cast<double>(s.count);
}

VectorXd coherence(const Spectra& s) { return s.Sxy.cwiseAbs2().cwiseQuotient(s.Sxx.cwiseProduct(s.Syy)); }

VectorXcd frequency_response(const Spectra& s, ResponseEstimator estimator) {
  switch (estimator) {
    case ResponseEstimator::h1: return s.Sxy.cwiseQuotient(s.Sxx.cast<std::complex<double>>());
    case ResponseEstimator::h2: return s.Syy.cast<std::complex<double>>().cwiseQuotient(s.Sxy.conjugate());
    case ResponseEstimator::hv: break;
  }
  const VectorXd magnitude = s.Syy.cwiseQuotient(s.Sxx).cwiseSqrt();
  return s.Sxy.cwiseQuotient(s.Sxy.cwiseAbs().cast<std::complex<double>>())
      .cwiseProduct(magnitude.cast<std::complex<double>>());
}

VectorXd relative_response_deviation(const Spectra& s) {
  const Eigen::ArrayXd gamma2 = coherence(s).array().min(1.0);
  return ((1.0 - gamma2) / (2.0 * s.averages * gamma2)).sqrt();
}

Bounds response_bounds(const Spectra& s, double deviations) {
  const Eigen::ArrayXd magnitude = frequency_response(s, ResponseEstimator::h1).cwiseAbs();
  const Eigen::ArrayXd deviation = deviations * relative_response_deviation(s).array();
  return {.lower = magnitude * (1.0 - deviation).max(0.0), .upper = magnitude * (1.0 + deviation)};
}

Bounds coherence_bounds(const Spectra& s, double deviations) {
  const VectorXd gamma2 = coherence(s);
  const double half_width = deviations / std::sqrt(2.0 * s.averages);
  const auto bound = [&](double sign) -> VectorXd {
    return gamma2.unaryExpr([=](double g2) {
      const double w = std::atanh(std::min(std::sqrt(g2), 1.0 - 1e-15)) + sign * half_width;
      return std::pow(std::tanh(std::max(w, 0.0)), 2);
    });
  };
  return {.lower = bound(-1.0), .upper = bound(1.0)};
}

Spectrogram spectrogram(const VectorXd& x, double rate, const SegmentSettings& settings) {
  const Segments s = cut(x.size(), settings);
  const VectorXd scale = density_scale(s, rate);
  Spectrogram result{.time = VectorXd(s.count),
                     .frequency = frequencies(s.length, rate),
                     .density = Eigen::MatrixXd(s.length / 2 + 1, s.count)};
  for (Eigen::Index i = 0; i < s.count; ++i) {
    result.time[i] = (static_cast<double>(i * s.step) + 0.5 * static_cast<double>(s.length)) / rate;
    result.density.col(i) = s.transform(x, i).cwiseAbs2().cwiseProduct(scale);
  }
  return result;
}

}  // namespace pfdm
