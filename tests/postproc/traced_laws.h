#pragma once
// Records of planes that went through known states, for laws that are exported.

#include "postproc/exports/export_formats.h"
#include "tests/postproc/deck_readers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::test {

using Curve = std::function<double(double)>;  // traction [Pa] at a separation [m]

using States = std::vector<TractionPoint>;

/// A plane with one place that went through these states; its columns dissipate `dissipated`.
inline CohesiveReport report_of(const States& states, double dissipated = 10.0) {
  ColumnRecord record{.name = "band", .kind = SurfaceKind::plane, .places = {{.area = 2.0}}, .steps = {}};
  record.steps.push_back({ColumnSample{}});
  for (const auto& [separation, traction] : states)
    record.steps.push_back({{.traction = Vector(traction, 0, 0),
                             .separation = Vector(separation, 0, 0),
                             .surface_energy = dissipated,
                             .largest_damage = 1.0}});
  CohesiveReport report{
      .case_name = "bar", .case_hash = "0123", .version = "9.9", .records = {record}, .results = {{}}, .curve = {}};
  for (CohesiveLaw& law : averaged_laws(record)) {
    const CohesiveFigures figures = figures_of(record, law);
    report.results[0].push_back({.law = std::move(law), .figures = figures, .fits = {}});
  }
  return report;
}

/// Through `n` states of the curve up to `end`.
inline CohesiveReport report_of(const Curve& curve, double end, int n = 240, double dissipated = 10.0) {
  States states;
  for (int i = 0; i <= n; ++i) states.push_back({end * i / n, curve(end * i / n)});
  return report_of(states, dissipated);
}

inline constexpr double um = 1e-6, MPa = 1e6;

inline double rigid(double w) { return 2 * MPa * std::exp(-w / (3 * um)); }
inline double straight(double w) { return w < 0.5 * um ? 4e12 * w : 2 * MPa * std::exp(-(w - 0.5 * um) / (3 * um)); }
inline double smooth(double w) { return 2 * MPa * std::cbrt(w / (1 * um)) * std::exp((1 - w / (1 * um)) / 3); }
inline double breaks(double w) { return w < 3 * um ? 2 * MPa * std::sin(w / (3 * um)) : 0.0; }

inline const std::map<std::string, Curve> traced{{"rigid", rigid}, {"straight", straight}, {"smooth", smooth}};
inline constexpr double end_of_record = 12 * um;

inline double trapezoids(const CohesiveReport& report) {
  const std::vector<ColumnSample>& states = report.results[0][0].law.states;
  double sum = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i)
    sum += 0.5 * (states[i].traction[0] + states[i - 1].traction[0]) *
           (states[i].separation[0] - states[i - 1].separation[0]);
  return sum;
}

/// Area and peak of a law, by many small steps.
inline std::pair<double, double> area_and_peak(const Curve& law, double end, int n = 400000) {
  double area = 0.0, peak = 0.0;
  for (int i = 0; i < n; ++i) {
    const double T = law(end * (i + 0.5) / n);
    area += T * end / n;
    peak = std::max(peak, T);
  }
  return {area, peak};
}

inline void expect_close(double value, double expected, double tolerance = 1e-8) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

/// MOOSE's BiLinearMixedModeTraction::computeDamage; Abaqus' linear softening by energy is the same.
inline Curve bilinear(double K, double N, double G) {
  return [=](double w) {
    const double init = N / K, final_ = 2 * G / K / init;
    if (w > final_) return 0.0;
    const double d = w < init ? 0.0 : final_ * (w - init) / w / (final_ - init);
    return (1 - d) * K * w;
  };
}

}  // namespace pfdm::test
