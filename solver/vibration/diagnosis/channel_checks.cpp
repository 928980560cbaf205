#include "solver/vibration/diagnosis/channel_checks.h"

#include "solver/vibration/signals/signals_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {
using Eigen::VectorXd;

/// Several successive samples at the same extreme value: an analogue-digital converter at the end of its range.
void check_clipped(const char* channel, const VectorXd& x, std::vector<RecordFault>& faults) {
  for (const double extreme : {x.maxCoeff(), x.minCoeff()}) {
    Eigen::Index runs = 0;
    Eigen::Index length = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      length = x[i] == extreme ? length + 1 : 0;
      runs += length == 3;
    }
    if (runs < 3) continue;
    faults.push_back({"clipped",
                      fmt::format("{} may be clipped: it stays at {:.6g} m/s^2 for three samples or more, {} times",
                                  channel, extreme, runs),
                      false});
    return;
  }
}

/// Smallest step between different samples; 0 of a constant.
double smallest_step(const VectorXd& x) {
  VectorXd sorted = x;
  std::ranges::sort(sorted);
  const double rounding = 1e-9 * (sorted[sorted.size() - 1] - sorted[0]);
  double step = 0.0;
  for (Eigen::Index i = 1; i < sorted.size(); ++i) {
    const double up = sorted[i] - sorted[i - 1];
    if (up > rounding && (step == 0.0 || up < step)) step = up;
  }
  return step;
}

/// A converter with too few steps for this level, or numbers printed with too few digits.
bool check_quantised(const char* channel, const VectorXd& x, std::vector<RecordFault>& faults) {
  constexpr double coarse = 0.02;  // of the rms
  const double step = smallest_step(x), level = rms((x.array() - x.mean()).matrix());
  if (!(step > coarse * level)) return false;
  faults.push_back(
      {"quantised",
       fmt::format("{} is quantised in steps of {:.3g} m/s^2, {:.2g} of its rms", channel, step, step / level), false});
  return true;
}

/// Stretches that stay at one value amid the motion, of at least eight samples, and a thirtieth of a period.
void check_dropouts(const char* channel, const VectorXd& x, double rate, double band_high,
                    std::vector<RecordFault>& faults) {
  const Eigen::Index least = std::max<Eigen::Index>(8, static_cast<Eigen::Index>(std::ceil(rate / (30.0 * band_high))));
  const double most = x.maxCoeff(), lowest = x.minCoeff();
  Eigen::Index stretches = 0, samples = 0, first = 0;
  for (Eigen::Index begin = 0, end = 0; begin < x.size(); begin = end) {
    for (end = begin + 1; end < x.size() && x[end] == x[begin];) ++end;
    const bool at_an_end = begin == 0 || end == x.size();
    const bool is_extreme = x[begin] == most || x[begin] == lowest;
    if (end - begin < least || at_an_end || is_extreme) continue;
    if (stretches++ == 0) first = begin;
    samples += end - begin;
  }
  if (stretches == 0) return;
  faults.push_back({"dropouts",
                    fmt::format("{} is constant over {} stretches, {:.3g} s in all, the first at {:.4g} s", channel,
                                stretches, static_cast<double>(samples) / rate, static_cast<double>(first) / rate),
                    false});
}

/// An offset is removed later; a drift is not an acceleration of the test.
void check_drift(const char* channel, const VectorXd& x, double rate, double band_low,
                 std::vector<RecordFault>& faults) {
  const PassBand slow{.low = 0.0, .high = 0.1 * band_low, .skirt = 0.5};
  const double wandering = rms(filtered((x.array() - x.mean()).matrix(), rate, slow));
  if (wandering > 0.05 * rms((x.array() - x.mean()).matrix()))
    faults.push_back(
        {"drift", fmt::format("{} drifts, with an rms of {:.3g} m/s^2 below {:.3g} Hz", channel, wandering, slow.high),
         false});
}

/// Single samples far off the line between their neighbours.
void check_spikes(const char* channel, const VectorXd& x, std::vector<RecordFault>& faults) {
  const Eigen::Index n = x.size() - 2;
  const VectorXd off = (x.segment(1, n) - 0.5 * (x.head(n) + x.tail(n))).cwiseAbs();
  const double usual = sample_quantile(off, 0.5);
  Eigen::Index where = 0;
  const double largest = off.maxCoeff(&where);
  // A sweep's own curvature grows with frequency and through resonance; a spike is beyond its neighbours too.
  const double nearby =
      std::max(off[std::max<Eigen::Index>(where - 3, 0)], off[std::min<Eigen::Index>(where + 3, n - 1)]);
  if (usual > 0.0 && largest > 30.0 * usual && largest > 5.0 * nearby)
    faults.push_back({"spikes", fmt::format("{} has a spike at sample {}", channel, where + 1), false});
}

}  // namespace

double sample_quantile(VectorXd values, double part) {
  const auto at = static_cast<Eigen::Index>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[at];
}

void check_channel(const char* channel, const VectorXd& x, double rate, double band_low, double band_high,
                   std::vector<RecordFault>& faults) {
  if (!check_quantised(channel, x, faults)) {
    check_clipped(channel, x, faults);
    check_dropouts(channel, x, rate, band_high, faults);
  }
  check_drift(channel, x, rate, band_low, faults);
  check_spikes(channel, x, faults);
}

}  // namespace pfdm
