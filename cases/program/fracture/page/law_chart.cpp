#include "cases/program/fracture/page/law_chart.h"

#include "cases/program/fracture/outcome/debonded_poles.h"
#include "physics/angle.h"
#include "physics/interfaces/traction_separation.h"
#include "postproc/cohesive/cohesive_results.h"
#include "postproc/cohesive/flat_surface.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

double strength_of(const CohesiveResult& result) {
  return std::isfinite(result.figures.strength) ? result.figures.strength : 0.0;
}

/// By more than half of the strength, or from a fifth of it or more to nearly nothing.
bool falls_within_a_step(const ColumnSample& before, const ColumnSample& after, double strength) {
  const double fall = before.traction[0] - after.traction[0];
  return fall > 0.5 * strength || (fall > 0.2 * strength && after.traction[0] < 0.1 * before.traction[0]);
}

Series law_series(const CohesiveResult& result, const DisplayUnit& x, const DisplayUnit& y) {
  Series series{.label = {}, .x = {}, .y = {}};
  const std::vector<ColumnSample>& states = result.law.states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i > 0 && falls_within_a_step(states[i - 1], states[i], strength_of(result))) {
      series.x.push_back(std::nan(""));
      series.y.push_back(std::nan(""));
    }
    series.x.push_back(x.factor * states[i].separation[0]);
    series.y.push_back(y.factor * states[i].traction[0]);
  }
  return series;
}

bool jumps(const Series& series) {
  return std::ranges::any_of(series.y, [](double value) { return std::isnan(value); });
}

/// The analytic law that is nearest.
Series fitted_series(const CohesiveResult& result, const DisplayUnit& x, const DisplayUnit& y) {
  const CohesiveFit& fit = result.fits.front();
  const auto laws = traction_separation_laws();
  const TractionSeparationLaw& law = *std::ranges::find(laws, fit.law, &TractionSeparationLaw::name);
  std::vector<double> p;
  for (const FitEstimate& estimate : fit.result.estimates) p.push_back(estimate.value);
  Series series{.label = fmt::format("{}: {}, {:.4g} J/m²", fit.law, shown(p[0], "Pa"), p[1]),
                .x = {},
                .y = {},
                .style = SeriesStyle::dashed,
                .colour = 2};
  constexpr int n = 200;
  for (int i = 0; i <= n; ++i) {
    const double separation = result.figures.final_separation * std::max(1e-6, static_cast<double>(i) / n);
    series.x.push_back(x.factor * separation);
    series.y.push_back(y.factor * law.traction(law, separation, p[0], p[1], std::span(p).subspan(2)));
  }
  return series;
}

/// "lower pole, 165°–180°"
std::string label_of(const CohesiveLaw& law, const ColumnRecord& record, const Vector& axis) {
  if (is_flat(record.kind, record.places)) return "mean of all places";
  const std::string angles = fmt::format("{:.0f}°–{:.0f}°", law.from / degree, law.to / degree);
  if (law.from == 0.0) return fmt::format("{}, {}", name_of_pole(true, axis), angles);
  return law.to == std::numbers::pi ? fmt::format("{}, {}", name_of_pole(false, axis), angles) : angles;
}

}  // namespace

Chart law_chart(const ColumnRecord& record, const Vector& axis) {
  std::vector<CohesiveResult> results = evaluate(record);
  double widest = 0.0;
  for (const CohesiveResult& r : results)
    for (const ColumnSample& state : r.law.states) widest = std::max(widest, state.separation[0]);
  const auto strongest = std::ranges::max_element(results, {}, strength_of);
  const double largest = strength_of(*strongest);
  std::rotate(results.begin(), strongest, strongest + 1);
  std::erase_if(results, [&](const CohesiveResult& r) { return strength_of(r) < 0.5 * largest; });
  const DisplayUnit x = display_unit(widest, "m"), y = display_unit(largest, "Pa");
  Chart chart{.caption = fmt::format("Cohesive law of \"{}\"", record.name),
              .x = {.title = fmt::format("normal separation [{}]", x.name)},
              .y = {.title = fmt::format("normal traction [{}]", y.name)},
              .series = {}};
  for (const CohesiveResult& r : results) {
    chart.series.push_back(law_series(r, x, y));
    chart.series.back().label = label_of(r.law, record, axis);
    chart.series.back().colour = static_cast<int>(chart.series.size()) - 1;
  }
  chart.series.front().style = SeriesStyle::line_with_points;
  const bool some_jump = std::ranges::any_of(chart.series, jumps);
  if (results.size() == 1 && !results.front().fits.empty())
    chart.series.push_back(fitted_series(results.front(), x, y));
  chart.x.logarithmic = some_jump;  // little is opened before a jump, much after it
  if (some_jump) chart.x.from = 1e-4 * x.factor * widest;
  return chart;
}

}  // namespace pfdm
