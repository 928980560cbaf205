#include "solver/vibration/diagnosis/identification_faults.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/diagnosis/identification_lost_samples.h"
#include "solver/vibration/identification/identification_conditioning.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/signals/signals_fourier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double clearly_less = 1.0 / 3.0;
constexpr double much = 0.1;  // of the response
constexpr int windows = 20;

struct Hypothesis {
  std::string fault;
  std::string undone;
  std::function<VibrationRecord(VibrationRecord)> undo;
};

/// The base later by so many samples, whole ones or not.
VibrationRecord shifted(VibrationRecord r, double samples) {
  const Eigen::Index n = fast_length(r.n() + 64);
  VectorXd padded = VectorXd::Zero(n);
  padded.head(r.n()) = r.base;
  Eigen::VectorXcd spectrum = fourier(padded);
  for (Eigen::Index k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k) * samples / static_cast<double>(n));
  r.base = inverse_fourier(spectrum, n).head(r.n());
  return r;
}

VibrationRecord scaled(VibrationRecord r, double factor) {
  r.relative *= factor;
  return r;
}

/// z'', z', z of the record, by integration within the band, and the base.
struct FilteredMotion {
  MatrixXd terms;
  VectorXd base;
};
FilteredMotion motion_of(const VibrationRecord& record, const PassBand& band) {
  FilteredMotion motion{.terms = MatrixXd(record.n(), 3), .base = filtered(record.base, record.rate, band)};
  for (int order = 0; order < 3; ++order)
    motion.terms.col(order) = integrated(record.relative, record.rate, order, band);
  return motion;
}

/// Factor of the relative channel with which a linear sample meets the base best: in -y'' = s z'' + ... it is 1 where
/// both have the same unit. In the upper half of the band: low frequencies of z'' that are integrated twice are mostly
/// noise.
double best_scale(const VibrationRecord& record) {
  const FilteredMotion motion = motion_of(record, {.low = std::sqrt(record.band_low * record.band_high),
                                                   .high = std::min(1.2 * record.band_high, 0.38 * record.rate)});
  return scaled_least_squares(motion.terms, -motion.base)[0];
}

Hypothesis of_scale(const VibrationRecord& record) {
  const double factor = best_scale(record);
  const auto is_about = [&](double unit) { return std::abs(factor / unit - 1.0) < 0.05; };
  const auto in_unit = [](const char* channel, const char* unit, double by) -> Hypothesis {
    return {fmt::format("the {} channel seems to be in another unit, {}", channel, unit), "converted",
            [by](VibrationRecord r) { return scaled(std::move(r), by); }};
  };
  constexpr double g0 = 9.80665;
  if (is_about(g0)) return in_unit("relative", "g0", g0);
  if (is_about(1.0 / g0)) return in_unit("base", "g0", 1.0 / g0);
  if (is_about(1e-3)) return in_unit("relative", "mm/s^2", 1e-3);
  if (is_about(1e3)) return in_unit("base", "mm/s^2", 1e3);
  constexpr double least_of_units = 2.0;
  if (factor < least_of_units && factor > 1.0 / least_of_units)
    return {
        fmt::format("the scale of one channel is off by a factor of {:.5g}, or the sample is softer or stiffer than "
                    "the model at these amplitudes",
                    factor),
        "the relative channel multiplied by it", [factor](VibrationRecord r) { return scaled(std::move(r), factor); }};
  return {fmt::format("the unit or the scale of one channel is wrong by a factor of {:.3g}", factor),
          "the relative channel multiplied by it",
          [factor](VibrationRecord r) { return scaled(std::move(r), factor); }};
}

/// The sine of a frequency that a channel holds, by least squares.
VectorXd sine_in(const VectorXd& channel, double rate, double frequency) {
  const VectorXd phase = VectorXd::LinSpaced(channel.size(), 0.0, static_cast<double>(channel.size() - 1)) *
                         (2.0 * std::numbers::pi * frequency / rate);
  MatrixXd waves(channel.size(), 2);
  waves.col(0) = phase.array().cos();
  waves.col(1) = phase.array().sin();
  return waves * scaled_least_squares(waves, channel);
}

/// The frequency within half a hertz of that of the mains at which a channel has most: by sums over a 20th of a second
/// each of the channel turned back by the nominal one.
double mains_frequency(const VectorXd& channel, double rate, double mains) {
  constexpr double drift = 0.5, lines_between = 4.0, second_in_sums = 20.0;
  const auto length = static_cast<Eigen::Index>(rate / second_in_sums);
  const Eigen::Index n_sums = channel.size() / length;
  Eigen::VectorXcd sums = Eigen::VectorXcd::Zero(n_sums);
  for (Eigen::Index i = 0; i < n_sums * length; ++i)
    sums[i / length] += channel[i] * std::polar(1.0, -2.0 * std::numbers::pi * mains * static_cast<double>(i) / rate);
  const int n = static_cast<int>(std::ceil(drift * lines_between * static_cast<double>(channel.size()) / rate));
  double best = mains, most = 0.0;
  for (int k = -n; k <= n; ++k) {
    const double off = drift * k / n;
    std::complex<double> sum = 0.0;
    for (Eigen::Index b = 0; b < n_sums; ++b)
      sum += sums[b] * std::polar(1.0, -2.0 * std::numbers::pi * off * static_cast<double>(b * length) / rate);
    if (!(std::abs(sum) > most)) continue;
    most = std::abs(sum);
    best = mains + off;
  }
  return best;
}

Hypothesis of_hum(const VibrationRecord& record, double mains, bool of_relative) {
  const double frequency = mains_frequency(of_relative ? record.relative : record.base, record.rate, mains);
  return {fmt::format("the {} channel has a hum of the mains, {:.4g} Hz", of_relative ? "relative" : "base", frequency),
          "taken out", [frequency, of_relative](VibrationRecord r) {
            VectorXd& humming = of_relative ? r.relative : r.base;
            humming -= sine_in(humming, r.rate, frequency);
            return r;
          }};
}

std::vector<Hypothesis> hypotheses(const VibrationRecord& record) {
  std::vector<Hypothesis> all{
      {"the sign of one channel is reversed (relative_unit = \"-1 m/s^2\" of the record turns it)", "turned",
       [](VibrationRecord r) { return scaled(std::move(r), -1.0); }},
      {"the relative channel holds the mass's own (absolute) acceleration (acceleration = \"absolute\" of the record)",
       "the base's subtracted",
       [](VibrationRecord r) {
         r.relative -= r.base;
         return r;
       }},
      {"the channels are exchanged (swapped)", "put back", [](VibrationRecord r) {
         r.base.swap(r.relative);
         return r;
       }}};
  if (best_scale(record) > 0.0) all.push_back(of_scale(record));
  for (const double mains : {50.0, 60.0})
    if (mains < record.rate / 2.0)
      for (const bool of_relative : {true, false}) all.push_back(of_hum(record, mains, of_relative));
  for (const double size : {0.25, 0.5, 1.0, 1.5, 2.0})
    for (const double samples : {size, -size})
      all.push_back({fmt::format("the {} channel is {:g} sample{} behind the other",
                                 samples > 0.0 ? "relative" : "base", size, size > 1.0 ? "s" : ""),
                     "moved", [samples](VibrationRecord r) { return shifted(std::move(r), samples); }});
  return all;
}

/// Of the equation of motion, by least squares, which is quick; infinite where no terms dissipate.
double equation_misfit(const VibrationRecord& record, const ModelStructure& structure, int order,
                       const IdentificationSettings& settings) {
  const auto found = regress_separable(std::span(&record, 1), structure, order, settings);
  return found ? found->misfit : std::numeric_limits<double>::infinity();
}

/// Of the response that the model gives when it is fitted to the record.
double output_misfit(const VibrationRecord& record, const ModelStructure& structure, int order,
                     IdentificationSettings settings) {
  settings.replicates = 0;
  const auto start = regress_separable(std::span(&record, 1), structure, order, settings);
  if (!start) return std::numeric_limits<double>::infinity();
  const OutputErrorFit fit = refine_output(std::span(&record, 1), start->model, settings);
  return fit.record_misfit.empty() ? std::numeric_limits<double>::infinity() : fit.record_misfit.front();
}

/// The part of the mass's acceleration that is a ring-down: free motion by the equation of the rest of the record, and
/// decaying. None of a motion that something else drives.
double explained_by_ring_down(const MatrixXd& terms, const VectorXd& equation) {
  constexpr double least = 0.9, decays = 0.95;
  const Eigen::Index half = terms.rows() / 2;
  const double first = terms.col(0).head(half).norm(), second = terms.col(0).tail(half).norm();
  const double inertia = std::abs(equation[0]) * terms.col(0).norm();
  if (!(inertia > 0.0 && second < decays * first)) return 0.0;
  const double explained = 1.0 - std::pow((terms * equation).norm() / inertia, 2);
  return explained > least ? explained : 0.0;
}

/// By window, the part of the base's acceleration that the mass's motion accounts for; of a base at rest, the part of
/// the mass's acceleration that is a ring-down, and all where nothing happens at all.
std::vector<double> explained_by_motion(const VibrationRecord& record) {
  constexpr double least_level = 0.01;
  const auto [motion, base] =
      motion_of(record, {.low = 0.5 * record.band_low, .high = std::min(3.0 * record.band_high, 0.38 * record.rate)});
  const Eigen::Index length = record.n() / windows;
  const double base_level = base.norm() / std::sqrt(windows), level = motion.col(0).norm() / std::sqrt(windows);
  const VectorXd equation = scaled_least_squares(motion, base);
  std::vector<double> explained;
  for (int w = 0; w < windows; ++w) {
    const VectorXd y = base.segment(w * length, length);
    const MatrixXd A = motion.middleRows(w * length, length);
    if (!(y.norm() > least_level * base_level)) {
      explained.push_back(A.col(0).norm() > least_level * level ? explained_by_ring_down(A, equation) : 1.0);
      continue;
    }
    const double left = A.isZero(0.0) ? y.norm() : (A * scaled_least_squares(A, y) - y).norm();
    explained.push_back(1.0 - left * left / y.squaredNorm());
  }
  return explained;
}

/// Whether undoing a fault leaves a third of the misfit at most, and of the response where no model fitted.
bool explains(double after, double misfit) {
  return after < 1.0 && after < clearly_less * (std::isfinite(misfit) ? misfit : 1.0);
}

/// The channels put in step where one of them has lost samples. `least`: the misfit that is to fall by two thirds.
std::optional<std::string> lost_samples_of(const VibrationRecord& record, double misfit, double least,
                                           const ModelStructure& structure, int order,
                                           const IdentificationSettings& settings) {
  const auto lost = lost_samples(record, structure.stiffness_order);
  if (!lost) return std::nullopt;
  const double after = output_misfit(lost->longer, structure, order, settings);
  if (!explains(after, least)) return std::nullopt;
  const int n = std::abs(lost->number);
  const std::string what = lost->time == 0.0 ? fmt::format("the {} channel is {} samples behind the other",
                                                           lost->number < 0 ? "relative" : "base", n)
                                             : fmt::format("{} samples of the {} channel are missing at about {:.3g} s",
                                                           n, lost->number > 0 ? "relative" : "base", lost->time);
  return fmt::format("{}: put in step, the misfit of the longer part falls from {:.3g} to {:.3g}", what, misfit, after);
}

std::optional<std::string> fault_of(const VibrationRecord& record, double misfit, const ModelStructure& structure,
                                    const IdentificationSettings& settings) {
  if (const auto dead = dead_part(record))
    return fmt::format("a channel is dead from {:.3g} to {:.3g} s", dead->first, dead->second);
  const int order = structure.forcing == KernelForcing::none ? 0 : 1;
  const double now = equation_misfit(record, structure, order, settings);
  double least = 0.8 * now;
  std::optional<Hypothesis> best;
  for (const Hypothesis& h : hypotheses(record)) {
    const double there = equation_misfit(h.undo(record), structure, order, settings);
    if (!(there < least)) continue;
    least = there;
    best = h;
  }
  const double after = best ? output_misfit(best->undo(record), structure, order, settings) : misfit;
  if (!best || !explains(after, misfit)) return lost_samples_of(record, misfit, misfit, structure, order, settings);
  if (after > much)  // half explained, as a skew of five samples is by two
    if (auto lost = lost_samples_of(record, misfit, after, structure, order, settings)) return lost;
  return fmt::format("{}: {}, the misfit falls from {:.3g} to {:.3g}", best->fault, best->undone, misfit, after);
}

}  // namespace

std::optional<std::pair<double, double>> dead_part(const VibrationRecord& record) {
  constexpr double explained_if_dead = 0.1, explained_if_alive = 0.4;
  if (record.base.isConstant(record.base[0])) return std::nullopt;  // held, as for a ring-down
  const std::vector<double> explained = explained_by_motion(record);
  int first = windows, last = -1;
  for (int w = 1; w + 1 < windows; ++w)  // the ends may be ramps
    if (explained[w] < explained_if_dead) {
      first = std::min(first, w);
      last = w;
    }
  if (last <= first || !(std::ranges::max(explained) > explained_if_alive)) return std::nullopt;
  const auto samples = record.n() / windows;
  const double seconds = static_cast<double>(samples) / record.rate;
  return std::pair{first * seconds, last + 2 == windows ? record.duration() : (last + 1) * seconds};
}

std::vector<std::string> recognised_faults(std::span<const VibrationRecord> records, std::span<const double> misfit,
                                           const ModelStructure& structure, const IdentificationSettings& settings) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < records.size(); ++i)
    if (const auto fault = fault_of(records[i], misfit[i], structure, settings))
      faults.push_back(fmt::format("test {}: {}", records[i].name, *fault));
  return faults;
}

}  // namespace pfdm
