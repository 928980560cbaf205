#include "solver/vibration/diagnosis/vibration_checks.h"

#include "solver/vibration/diagnosis/channel_checks.h"
#include "solver/vibration/signals/signals_filter.h"
#include "solver/vibration/signals/signals_fourier.h"
#include "solver/vibration/signals/signals_spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {
using Eigen::VectorXd;
using Faults = std::vector<RecordFault>;

constexpr double least_periods = 20.0;      // of the lowest frequency, in a record
constexpr double highest_of_rate = 0.3907;  // of the band; analysers sample at 2.56 times the band

void check_lengths(const RawRecord& r, Faults& faults) {
  if (r.base.size() != r.relative.size() || (r.time && r.time->size() != r.base.size()))
    faults.push_back(
        {"unequal_lengths", fmt::format("the channels differ in length: {} and {} samples{}", r.base.size(),
                                        r.relative.size(), r.time ? fmt::format(", time {}", r.time->size()) : "")});
  if (r.base.size() < 16) faults.push_back({"too_short", fmt::format("the record has {} samples", r.base.size())});
}

void check_finite(const char* channel, const VectorXd& x, Faults& faults) {
  const auto bad = std::ranges::find_if(x, [](double v) { return !std::isfinite(v); });
  if (bad == x.end()) return;
  const auto count = std::ranges::count_if(x, [](double v) { return !std::isfinite(v); });
  faults.push_back({"not_finite", fmt::format("{} has {} samples that are not finite, the first at sample {}", channel,
                                              count, bad - x.begin())});
}

void check_time(const RawRecord& r, Faults& faults) {
  if (!r.time) {
    if (!r.rate)
      faults.push_back(
          {"no_rate",
           "there is neither a column of times nor a sampling rate: time = \"NAME\" of the record names the "
           "column, or rate = \"10 kHz\" states it"});
    return;
  }
  const VectorXd& t = *r.time;
  const VectorXd dt = t.tail(t.size() - 1) - t.head(t.size() - 1);
  const double step = sample_quantile(dt, 0.5);
  for (Eigen::Index i = 0; i < dt.size(); ++i) {
    if (dt[i] > 0.0) continue;
    faults.push_back(
        {"time_runs_backwards",
         fmt::format("time does not increase: from {:.10g} s to {:.10g} s at sample {}", t[i], t[i + 1], i + 1)});
    return;
  }
  for (Eigen::Index i = 0; i < dt.size(); ++i) {
    if (dt[i] <= 1.5 * step) continue;
    faults.push_back({"gap", fmt::format("{:.3g} s are missing after {:.10g} s", dt[i] - step, t[i])});
    return;
  }
  // Times are printed with few digits: the criterion is the distance of samples from an even grid.
  const auto n = static_cast<double>(t.size() - 1);
  const double even = (t[t.size() - 1] - t[0]) / n;
  double stray = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i)
    stray = std::max(stray, std::abs(t[i] - t[0] - even * static_cast<double>(i)));
  if (stray > 0.1 * even)
    faults.push_back({"uneven_sampling",
                      fmt::format("samples are up to {:.2g} of the sampling interval off an even grid", stray / even)});
  if (r.rate && std::abs(*r.rate * even - 1.0) > 1e-3)
    faults.push_back({"wrong_rate", fmt::format("the sampling rate is given as {} Hz; the times give {:.6g} Hz",
                                                *r.rate, 1.0 / even)});
}

void check_extent(const RawRecord& r, double rate, Faults& faults) {
  const double duration = static_cast<double>(r.base.size()) / rate;
  if (duration * r.band_low < least_periods)
    faults.push_back({"too_short", fmt::format("{:.3g} s contain {:.2g} periods of {} Hz; at least {} are required",
                                               duration, duration * r.band_low, r.band_low, least_periods)});
  if (r.band_high > highest_of_rate * rate)
    faults.push_back({"sampled_too_slowly",
                      fmt::format("the excitation reaches {} Hz; {:.6g} samples per second resolve up to {:.4g} Hz",
                                  r.band_high, rate, highest_of_rate * rate)});
}

bool is_constant(const VectorXd& x) {
  return x.maxCoeff() - x.minCoeff() <= 1e-9 * std::abs(x.mean()) || x.isZero(0.0);
}

/// The last quarter of the motion is half as strong as the first, or less.
bool dies_away(const VectorXd& x) {
  const VectorXd motion = x.array() - x.mean();
  const Eigen::Index quarter = x.size() / 4;
  return 2.0 * motion.tail(quarter).norm() < motion.head(quarter).norm();
}

double rms_of_motion(const VectorXd& x) { return rms((x.array() - x.mean()).matrix()); }

/// Steady, and as strong beside the stated band as noise is.
bool is_noise(const RawRecord& r) {
  constexpr double most_within = 0.92;  // of the rms
  const PassBand band{.low = 0.8 * r.band_low, .high = 1.2 * r.band_high};
  return !dies_away(r.base) && rms(filtered(r.base, sampling_rate(r), band)) < most_within * rms_of_motion(r.base);
}

/// The mass rings down, and the base's channel is constant, or noise below a hundredth of the mass's motion.
bool is_ring_down(const RawRecord& r) {
  constexpr double quiet = 0.01;
  if (is_constant(r.relative) || !dies_away(r.relative)) return false;
  return is_constant(r.base) || (rms_of_motion(r.base) < quiet * rms_of_motion(r.relative) && is_noise(r));
}

void check_dead(const RawRecord& r, Faults& faults) {
  if (is_constant(r.relative))
    faults.push_back({"dead_channel", fmt::format("the relative acceleration is constant, {}", r.relative[0])});
  if (is_ring_down(r))
    faults.push_back({"base_at_rest",
                      fmt::format("the mass's motion dies away, and the base has {:.2g} of it throughout: taken as a "
                                  "ring-down on a base at rest",
                                  rms_of_motion(r.base) / rms_of_motion(r.relative)),
                      false});
  else if (is_constant(r.base))
    faults.push_back({"dead_channel", fmt::format("the base's acceleration is constant, {}", r.base[0])});
}

void check_band(const RawRecord& r, double rate, Faults& faults) {
  const PassBand band{.low = 0.8 * r.band_low, .high = 1.2 * r.band_high};
  const double within = rms(filtered(r.base, rate, band));
  const double all = rms((r.base.array() - r.base.mean()).matrix());
  if (within < 0.5 * all)
    faults.push_back({"outside_the_band",
                      fmt::format("only {:.0f} % of the base's motion lies between {} and {} Hz", 100.0 * within / all,
                                  r.band_low, r.band_high),
                      false});
}

/// Below this frequency lies this part of the power [Hz].
double power_quantile(const VectorXd& power, double bin, double part) {
  const double all = power.sum();
  double sum = 0.0;
  for (Eigen::Index k = 0; k < power.size(); ++k)
    if ((sum += power[k]) >= part * all) return static_cast<double>(k) * bin;
  return static_cast<double>(power.size() - 1) * bin;
}

/// Where the base's power lies, over where it would by the stated band: near the lower end and near the upper one.
struct BandRatios {
  double low = 1.0, high = 1.0;
  double factor() const { return 0.5 * (low + high); }
  double apart() const { return std::abs(low - high) / factor(); }
};

BandRatios band_ratios(const RawRecord& r, double rate, bool logarithmic) {
  constexpr double part = 0.05;
  const VectorXd power = fourier((r.base.array() - r.base.mean()).matrix()).cwiseAbs2();
  // Noise far beside the band has to count less than what ends there: three times the mean of its power, whose tenth
  // lies below 0.105 of the mean.
  const double floor = 3.0 / 0.105 * sample_quantile(power, 0.1), bin = rate / static_cast<double>(r.base.size());
  const VectorXd above = (power.array() - floor).cwiseMax(0.0);
  const auto expected = [&](double q) {
    return logarithmic ? r.band_low * std::pow(r.band_high / r.band_low, q)
                       : r.band_low + q * (r.band_high - r.band_low);
  };
  return {.low = power_quantile(above, bin, part) / expected(part),
          .high = power_quantile(above, bin, 1.0 - part) / expected(1.0 - part)};
}

/// Both ends of what is excited off by one factor: the time scale is wrong. Of a flat spectrum, or one of a sweep.
void check_time_scale(const RawRecord& r, double rate, Faults& faults) {
  constexpr double noticeable = 0.04, alike = 0.05;
  if (!(r.band_high > 1.5 * r.band_low)) return;
  const BandRatios linear = band_ratios(r, rate, false), logarithmic = band_ratios(r, rate, true);
  const BandRatios& ratios = linear.apart() <= logarithmic.apart() ? linear : logarithmic;
  const double factor = ratios.factor();
  if (!(std::abs(factor - 1.0) > noticeable && ratios.apart() < alike)) return;
  faults.push_back(
      {"rate_or_band",
       fmt::format("the base is excited from {:.3g} to {:.3g} Hz and not from {:g} to {:g} Hz: the sampling "
                   "rate may be {:.4g} Hz and not {:g} Hz",
                   factor * r.band_low, factor * r.band_high, r.band_low, r.band_high, rate / factor, rate),
       false});
}

bool any_refused(const Faults& faults) {
  return std::ranges::any_of(faults, [](const RecordFault& f) { return f.refused; });
}

}  // namespace

double sampling_rate(const RawRecord& r) {
  if (!r.time) return r.rate.value_or(0.0);
  const VectorXd& t = *r.time;
  const double by_time = static_cast<double>(t.size() - 1) / (t[t.size() - 1] - t[0]);
  return r.rate ? *r.rate : by_time;
}

std::vector<RecordFault> check_record(const RawRecord& r) {
  Faults faults;
  check_lengths(r, faults);
  if (any_refused(faults)) return faults;
  const std::pair<const char*, const VectorXd*> channels[] = {{"the base's acceleration", &r.base},
                                                              {"the relative acceleration", &r.relative}};
  if (r.time) check_finite("the time", *r.time, faults);
  for (const auto& [name, x] : channels) check_finite(name, *x, faults);
  if (any_refused(faults)) return faults;
  check_time(r, faults);
  check_dead(r, faults);
  if (any_refused(faults)) return faults;
  const double rate = sampling_rate(r);
  check_extent(r, rate, faults);
  if (any_refused(faults)) return faults;
  const bool base_rests = is_ring_down(r);
  for (const auto& [name, x] : channels) {
    if (x == &r.base && base_rests) continue;
    check_channel(name, *x, rate, r.band_low, r.band_high, faults);
  }
  if (base_rests) return faults;
  check_band(r, rate, faults);
  check_time_scale(r, rate, faults);
  return faults;
}

}  // namespace pfdm
