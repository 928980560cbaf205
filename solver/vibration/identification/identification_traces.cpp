#include "solver/vibration/identification/identification_traces.h"

#include "solver/calibration/calibration_statistics.h"
#include "solver/vibration/signals/signals_fourier.h"
#include "solver/vibration/signals/signals_spectra.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Largest entry within [begin, end) that is not within `clear` of the middle.
double largest_beside(const VectorXd& p, Eigen::Index middle, Eigen::Index reach, Eigen::Index clear,
                      Eigen::Index begin, Eigen::Index end) {
  double most = 0.0;
  for (Eigen::Index k = std::max(begin, middle - reach); k < std::min(end, middle + reach + 1); ++k)
    if (std::abs(k - middle) > clear) most = std::max(most, p[k]);
  return most;
}

/// Moving average over 2 half + 1 entries, fewer at the ends.
VectorXd smoothed(const VectorXd& p, Eigen::Index half) {
  VectorXd sums(p.size() + 1);
  sums[0] = 0.0;
  for (Eigen::Index i = 0; i < p.size(); ++i) sums[i + 1] = sums[i] + p[i];
  VectorXd result(p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const Eigen::Index begin = std::max<Eigen::Index>(i - half, 0), end = std::min(i + half + 1, p.size());
    result[i] = (sums[end] - sums[begin]) / static_cast<double>(end - begin);
  }
  return result;
}

/// The same power at all frequencies of the band, nothing beside it.
VectorXd whitened(const VectorXd& x, double rate, double low, double high) {
  constexpr double width = 5.0;  // [Hz]
  const double bin = rate / static_cast<double>(x.size());
  VectorXcd spectrum = fourier(x);
  const VectorXd power = smoothed(spectrum.cwiseAbs2(), static_cast<Eigen::Index>(std::ceil(width / bin)));
  for (Eigen::Index k = 0; k < spectrum.size(); ++k) {
    const double f = static_cast<double>(k) * bin;
    spectrum[k] = f >= low && f <= high && power[k] > 0.0 ? spectrum[k] / std::sqrt(power[k]) : 0.0;
  }
  return inverse_fourier(spectrum, x.size());
}

}  // namespace

std::optional<Tone> tone_in(const VectorXd& x, double rate, double low, double high) {
  constexpr double reach = 20.0, stands_out = 5.0, least_part = 0.05;
  const double bin = rate / static_cast<double>(x.size());
  const VectorXd p = fourier(hann_window(x.size()).cwiseProduct(x)).cwiseAbs2();
  const auto begin = static_cast<Eigen::Index>(std::ceil(low / bin));
  const auto end = std::min(static_cast<Eigen::Index>(std::floor(high / bin)) + 1, p.size());
  const auto beside = static_cast<Eigen::Index>(std::ceil(reach / bin));
  const Eigen::Index clear = std::max<Eigen::Index>(3, static_cast<Eigen::Index>(std::ceil(0.5 / bin)));
  if (end - begin < 4 * clear || beside <= 2 * clear) return std::nullopt;
  const double all = p.segment(begin, end - begin).sum();
  std::optional<Tone> strongest;
  for (Eigen::Index k = begin + 1; k + 1 < end; ++k) {
    if (!(p[k] > p[k - 1] && p[k] >= p[k + 1] && p[k] > 0.3 * least_part * all)) continue;
    const Eigen::Index first = std::max(begin, k - 2), n = std::min(end, k + 3) - first;
    const double part = p.segment(first, n).sum() / all;
    if (part < least_part || (strongest && part <= strongest->part)) continue;
    if (p[k] > stands_out * largest_beside(p, k, beside, clear, begin, end))
      strongest = Tone{.frequency = static_cast<double>(k) * bin, .part = part};
  }
  return strongest;
}

std::optional<Burst> burst_in(const VectorXd& x, double rate, double low, double high) {
  constexpr double stands_out = 6.0, freedom = 60.0;
  constexpr Eigen::Index around = 25;
  const double seconds = std::max(freedom / (2.0 * (high - low)), 1.0 / low);
  const auto length = static_cast<Eigen::Index>(std::ceil(seconds * rate));
  const Eigen::Index n = x.size() / length;
  if (n < 2 * around) return std::nullopt;
  const VectorXd white = whitened(x, rate, low, high);
  VectorXd power(n);
  for (Eigen::Index w = 0; w < n; ++w) power[w] = white.segment(w * length, length).squaredNorm();
  Burst burst;
  for (Eigen::Index w = 1; w + 1 < n; ++w) {  // whitening takes the ends for neighbours
    const Eigen::Index begin = std::clamp<Eigen::Index>(w - around, 0, n - 2 * around), size = 2 * around;
    const auto beside = power.segment(begin, size);
    const double times = power[w] / quantile({beside.begin(), beside.end()}, 0.5);
    if (times > stands_out) ++burst.number;
    if (times <= burst.times) continue;
    burst.times = times;
    burst.time = (static_cast<double>(w) + 0.5) * static_cast<double>(length) / rate;
  }
  return burst.number > 0 ? std::optional(burst) : std::nullopt;
}

}  // namespace pfdm
