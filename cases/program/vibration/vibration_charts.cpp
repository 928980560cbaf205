#include "cases/program/vibration/vibration_charts.h"

#include "cases/program/session/report_parts.h"
#include "physics/point/mass_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

using Eigen::VectorXd;

/// In degrees between -270 and 90: a resonance's falls from 0 to -180 without a jump.
double falling_phase(const std::complex<double>& H) {
  const double phase = std::arg(H) * 180.0 / std::numbers::pi;
  return phase > 90.0 ? phase - 360.0 : phase;
}

std::vector<double> listed(const VectorXd& values, double factor = 1.0) {
  std::vector<double> list(values.begin(), values.end());
  for (double& value : list) value *= factor;
  return list;
}

/// Edges of intervals about evenly spaced middles.
struct Edges {
  double first, spacing;
  double operator[](Eigen::Index i) const { return first + spacing * static_cast<double>(i); }
};

Edges edges_about(const VectorXd& middles, Eigen::Index stride) {
  const double step = middles.size() > 1 ? middles[1] - middles[0] : 1.0;
  return {.first = middles[0] - 0.5 * step, .spacing = step * static_cast<double>(stride)};
}

}  // namespace

double rms_of(const VectorXd& signal) { return signal.norm() / std::sqrt(static_cast<double>(signal.size())); }

Series hull(const std::string& label, const VectorXd& signal, double rate, int colour) {
  constexpr Eigen::Index n_bins = 700;
  Series series{.label = label, .x = {}, .y = {}, .style = SeriesStyle::band, .colour = colour};
  const Eigen::Index n = signal.size(), bins = std::min(n_bins, n);
  for (Eigen::Index i = 0; i < bins; ++i) {
    const Eigen::Index from = i * n / bins, to = std::max((i + 1) * n / bins, from + 1);
    const auto part = signal.segment(from, to - from);
    series.x.push_back(0.5 * static_cast<double>(from + to - 1) / rate);
    series.y.push_back(part.minCoeff() / standard_gravity);
    series.upper.push_back(part.maxCoeff() / standard_gravity);
  }
  return series;
}

Chart base_chart(const VibrationRecord& r) {
  return {.caption = "Base",
          .x = {.title = "time [s]"},
          .y = {.title = "acceleration [g0]"},
          .series = {hull("", r.base, r.rate, 1)}};
}

Chart response_chart(const VibrationRecord& r) {
  return {.caption = "Mass relative to the base",
          .x = {.title = "time [s]"},
          .y = {.title = "acceleration [g0]"},
          .series = {hull("", r.relative, r.rate, 1)}};
}

BandSpectra in_band(const Spectra& s, const VibrationRecord& record) {
  const Eigen::VectorXcd H = frequency_response(s, ResponseEstimator::h1);
  const Eigen::VectorXcd H2 = frequency_response(s, ResponseEstimator::h2);
  const Eigen::VectorXcd Hv = frequency_response(s, ResponseEstimator::hv);
  const Bounds bounds = response_bounds(s), of_coherence = coherence_bounds(s);
  const VectorXd gamma = coherence(s);
  BandSpectra result;
  for (Eigen::Index i = 0; i < s.frequency.size(); ++i) {
    if (s.frequency[i] < record.band_low || s.frequency[i] > record.band_high) continue;
    result.frequency.push_back(s.frequency[i]);
    result.base.push_back(s.Sxx[i] / g0_squared);
    result.relative.push_back(s.Syy[i] / g0_squared);
    result.magnitude.push_back(std::abs(H[i]));
    result.magnitude_h2.push_back(std::abs(H2[i]));
    result.magnitude_hv.push_back(std::abs(Hv[i]));
    result.lower.push_back(bounds.lower[i]);
    result.upper.push_back(bounds.upper[i]);
    result.phase.push_back(falling_phase(H[i]));
    result.coherence.push_back(gamma[i]);
    result.coherence_lower.push_back(of_coherence.lower[i]);
    result.coherence_upper.push_back(of_coherence.upper[i]);
  }
  return result;
}

BandSpectra spectra_in_band(const VibrationRecord& record, const VectorXd& relative, SegmentSettings segments) {
  segments.length = std::min<Eigen::Index>(segments.length, record.n());
  return in_band(spectra(record.base, relative, record.rate, segments), record);
}

void blank_incoherent(BandSpectra& s, const std::vector<double>& coherence) {
  for (std::size_t i = 0; i < coherence.size(); ++i)
    if (!(coherence[i] >= least_coherence))
      for (auto* values : {&s.magnitude, &s.lower, &s.upper, &s.phase, &s.magnitude_h2, &s.magnitude_hv})
        (*values)[i] = std::nan("");
}

ChartAxis frequency_axis(const VibrationRecord& r) {
  return {
      .title = "frequency [Hz]", .logarithmic = r.band_high > 8.0 * r.band_low, .from = r.band_low, .to = r.band_high};
}

Chart density_chart(const VibrationRecord& r, const BandSpectra& s) {
  return {.caption = "Spectral densities",
          .x = frequency_axis(r),
          .y = {.title = "density [g0²/Hz]", .logarithmic = true},
          .series = {{.label = "base", .x = s.frequency, .y = s.base, .colour = 1},
                     {.label = "mass relative to the base", .x = s.frequency, .y = s.relative, .colour = 0}}};
}

Chart coherence_chart(const VibrationRecord& r, const BandSpectra& s) {
  return {.caption = "Coherence, base and relative acceleration, with 95 % bounds",
          .x = frequency_axis(r),
          .y = {.title = "coherence [-]", .from = 0.0, .to = 1.05},
          .series = {{.label = {}, .x = s.frequency, .y = s.coherence},
                     {.label = {},
                      .x = s.frequency,
                      .y = s.coherence_lower,
                      .style = SeriesStyle::band,
                      .colour = 7,
                      .upper = s.coherence_upper}}};
}

Picture spectrogram_picture(const Spectrogram& s, double highest_frequency) {
  constexpr Eigen::Index most_columns = 150, most_rows = 110;
  constexpr double decades_shown = 6.0;
  Eigen::Index rows = 0;
  while (rows < s.frequency.size() && s.frequency[rows] <= highest_frequency) ++rows;
  const Eigen::Index dx = (s.time.size() - 1) / most_columns + 1, dy = (rows - 1) / most_rows + 1;
  const Edges t = edges_about(s.time, dx), f = edges_about(s.frequency, dy);
  Picture picture{.caption = "Spectrogram of the relative acceleration",
                  .x_title = "time [s]",
                  .y_title = "frequency [Hz]",
                  .value_title = "log10 of density [g0²/Hz]",
                  .cells = {},
                  .lines = {},
                  .stretched = true};
  double most = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i + dx <= s.time.size(); i += dx)
    for (Eigen::Index k = 0; k + dy <= rows; k += dy) {
      // The largest of what the cell covers: a narrow line must not fade.
      const double density = s.density.block(k, i, dy, dx).maxCoeff() / g0_squared;
      const double value = std::log10(std::max(density, 1e-300));
      const Eigen::Index a = i / dx, b = k / dy;
      picture.cells.push_back({{{t[a], f[b]}, {t[a + 1], f[b]}, {t[a + 1], f[b + 1]}, {t[a], f[b + 1]}}, value});
      most = std::max(most, value);
    }
  picture.most = std::ceil(most);
  picture.least = picture.most - decades_shown;
  return picture;
}

Chart harmonics_chart(const TrackedResponse& tracked) {
  Chart chart{.caption = "Response at the driving frequency and its harmonics",
              .x = {.title = "driving frequency [Hz]"},
              .y = {.title = "amplitude [g0]", .logarithmic = true},
              .series = {}};
  const double level = 0.5 * tracked.median_base();  // beside the ramps
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < tracked.base.size(); ++i)
    if (tracked.base[i] > level) kept.push_back(i);
  const std::vector<double> f = listed(tracked.frequency(kept));
  chart.series.push_back(
      {.label = "base", .x = f, .y = listed(tracked.base(kept), 1.0 / standard_gravity), .colour = 7});
  for (Eigen::Index h = 0; h < tracked.harmonics.cols(); ++h)
    chart.series.push_back({.label = h == 0 ? "driving frequency" : fmt::format("{} times", h + 1),
                            .x = f,
                            .y = listed(tracked.harmonics.col(h)(kept), 1.0 / standard_gravity),
                            .colour = static_cast<int>(h)});
  return chart;
}

Chart modulus_chart(const std::vector<ModulusRow>& modulus) {
  std::vector<double> f, storage, loss;
  for (const ModulusRow& row : modulus) {
    f.push_back(row.frequency);
    storage.push_back(row.storage);
    loss.push_back(row.loss);
  }
  const DisplayUnit unit = common_unit({{storage, loss}}, "Pa");
  return {
      .caption = "Young's modulus of the sample",
      .x = {.title = "frequency [Hz]", .logarithmic = f.back() > 8.0 * f.front(), .from = f.front(), .to = f.back()},
      .y = {.title = fmt::format("modulus [{}]", unit.name), .from = 0.0},
      .series = {{.label = "storage", .x = f, .y = in_unit(storage, unit), .colour = 1},
                 {.label = "loss", .x = f, .y = in_unit(loss, unit), .colour = 2}}};
}

}  // namespace pfdm
