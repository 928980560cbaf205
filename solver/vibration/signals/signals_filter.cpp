#include "solver/vibration/signals/signals_filter.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/signals/signals_fourier.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace pfdm {
namespace {
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

double cosine_squared(double part) {
  const double c = std::cos(0.5 * std::numbers::pi * part);
  return c * c;
}

/// The signal with zeros up to a length that transforms fast.
VectorXcd padded_spectrum(const VectorXd& x, Eigen::Index length) {
  VectorXd padded = VectorXd::Zero(length);
  padded.head(x.size()) = x;
  return fourier(padded);
}

/// Noise makes the phase tremble. Its course is taken out as a polynomial, because the filter takes signals as
/// periodic.
VectorXd smoothed_phase(const VectorXd& phase, double rate, double bandwidth) {
  const Eigen::Index n = phase.size();
  const Eigen::Index n_fit = std::min<Eigen::Index>(n, 2000);
  Eigen::MatrixXd powers(n_fit, 8);
  VectorXd at(n_fit);
  const auto place = [&](Eigen::Index i) { return 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0; };
  for (Eigen::Index k = 0; k < n_fit; ++k) {
    const Eigen::Index i = (n - 1) * k / std::max<Eigen::Index>(n_fit - 1, 1);
    at[k] = phase[i];
    for (Eigen::Index p = 0; p < 8; ++p) powers(k, p) = std::pow(place(i), p);
  }
  const VectorXd c = least_squares(powers, at);
  VectorXd course(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = 0.0;
    for (Eigen::Index p = 8; p-- > 0;) sum = sum * place(i) + c[p];
    course[i] = sum;
  }
  return course + filtered(phase - course, rate, {.low = 0.0, .high = bandwidth, .skirt = 0.5});
}

}  // namespace

double PassBand::gain(double frequency) const {
  if (frequency < low)
    return frequency <= low * (1.0 - skirt) ? 0.0 : cosine_squared((low - frequency) / (low * skirt));
  if (frequency > high)
    return frequency >= high * (1.0 + skirt) ? 0.0 : cosine_squared((frequency - high) / (high * skirt));
  return 1.0;
}

VectorXd integrated(const VectorXd& x, double rate, int order, const PassBand& band) {
  const Eigen::Index length = fast_length(x.size());
  VectorXcd spectrum = padded_spectrum(x, length);
  for (Eigen::Index k = 0; k < spectrum.size(); ++k) {
    const double f = rate * static_cast<double>(k) / static_cast<double>(length);
    const double gain = band.gain(f);
    assert(gain == 0.0 || f > 0.0 || order <= 0);
    spectrum[k] *= gain == 0.0 ? Complex(0.0) : gain * std::pow(Complex(0.0, 2.0 * std::numbers::pi * f), -order);
  }
  // The derivative at half the rate has no real counterpart.
  if (order % 2 != 0 && length % 2 == 0) spectrum[spectrum.size() - 1] = 0.0;
  return inverse_fourier(spectrum, length).head(x.size());
}

VectorXd filtered(const VectorXd& x, double rate, const PassBand& band) { return integrated(x, rate, 0, band); }

VectorXcd analytic_signal(const VectorXd& x) {
  const Eigen::Index n = x.size();
  VectorXcd spectrum = fourier(x) * Complex(0.0, -1.0);
  spectrum[0] = 0.0;
  if (n % 2 == 0) spectrum[spectrum.size() - 1] = 0.0;
  const VectorXd quadrature = inverse_fourier(spectrum, n);
  VectorXcd result(n);
  result.real() = x;
  result.imag() = quadrature;
  return result;
}

VectorXd envelope(const VectorXd& x) { return analytic_signal(x).cwiseAbs(); }

VectorXd driving_phase(const VectorXd& x, double rate, const PassBand& band) {
  const VectorXcd analytic = analytic_signal(filtered(x, rate, band));
  VectorXd phase(x.size());
  phase[0] = std::arg(analytic[0]);
  for (Eigen::Index i = 1; i < x.size(); ++i)
    phase[i] = phase[i - 1] + std::arg(analytic[i] * std::conj(analytic[i - 1]));
  return phase;
}

Eigen::MatrixXcd harmonics(const VectorXd& x, double rate, const VectorXd& phase, int n, double bandwidth) {
  const PassBand low_pass{.low = 0.0, .high = bandwidth, .skirt = 0.5};
  Eigen::MatrixXcd result(x.size(), n);
  for (int h = 1; h <= n; ++h) {
    const Eigen::ArrayXd turned = static_cast<double>(h) * phase.array();
    result.col(h - 1).real() = filtered(2.0 * x.array() * turned.cos(), rate, low_pass);
    result.col(h - 1).imag() = filtered(-2.0 * x.array() * turned.sin(), rate, low_pass);
  }
  return result;
}

VectorXd tracked_sweep(const VectorXd& x, double rate, const PassBand& band, double bandwidth) {
  const VectorXd phase = smoothed_phase(driving_phase(x, rate, band), rate, bandwidth);
  const Eigen::MatrixXcd a = harmonics(x, rate, phase, 3, bandwidth);
  const auto turned_forward = [&](Eigen::Index h) -> VectorXd {
    VectorXd part(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i)
      part[i] = (a(i, h) * std::polar(1.0, static_cast<double>(h + 1) * phase[i])).real();
    return part;
  };
  VectorXd sum = turned_forward(0);
  // What noise alone would leave of the rest within the tracker's band; a harmonic that is no more is none.
  const double noise = (x - sum).norm() * std::sqrt(2.5 * bandwidth / (0.5 * rate));
  for (Eigen::Index h = 1; h < 3; ++h)
    if (const VectorXd part = turned_forward(h); part.norm() > 2.0 * noise) sum += part;
  return sum;
}

}  // namespace pfdm
