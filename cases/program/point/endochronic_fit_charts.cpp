#include "cases/program/point/endochronic_fit_charts.h"

#include "cases/program/point/plotted_strain.h"
#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/report_parts.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// What a file of a fit holds: components with a measured and a fitted stress.
std::vector<std::string> channels(const CsvTable& curve) {
  std::vector<std::string> result;
  constexpr std::string_view start = "measured_stress_", end = "_Pa";
  for (const std::string& name : curve.names)
    if (name.starts_with(start)) result.push_back(name.substr(start.size(), name.size() - start.size() - end.size()));
  return result;
}

/// One channel over its strain; several over the time.
Chart fit_chart(const ExperimentMisfit& experiment, const CsvTable& curve) {
  const std::vector<std::string> components = channels(curve);
  std::vector<std::vector<double>> stresses;
  stresses.reserve(components.size());
  for (const std::string& c : components) stresses.push_back(curve.column(fmt::format("measured_stress_{}_Pa", c)));
  const DisplayUnit unit = common_unit(stresses, "Pa");
  const bool over_strain =
      components.size() == 1 && std::ranges::find(curve.names, "strain_" + components[0]) != curve.names.end();
  const std::vector<double> x = over_strain ? plotted_strain(curve, components[0]) : curve.column("time_s");
  Chart chart{.caption = fmt::format("{} \"{}\", rms misfit {:.2g} %", experiment.fitted ? "Fit to" : "Prediction of",
                                     experiment.name, 100.0 * experiment.relative),
              .x = {.title = over_strain ? strain_title(components[0]) : "time [s]"},
              .y = {.title = fmt::format("stress [{}]", unit.name)},
              .series = {}};
  for (std::size_t i = 0; i < components.size(); ++i) {
    const int colour = 2 * static_cast<int>(i);
    chart.series.push_back({.label = "measured " + components[i],
                            .x = x,
                            .y = in_unit(stresses[i], unit),
                            .style = SeriesStyle::points,
                            .colour = colour});
    chart.series.push_back({.label = (experiment.fitted ? "fitted " : "predicted ") + components[i],
                            .x = x,
                            .y = in_unit(curve.column(fmt::format("fitted_stress_{}_Pa", components[i])), unit),
                            .colour = colour + 1});
  }
  return chart;
}

/// A test at given stress: its strains over the time.
Chart strain_fit_chart(const ExperimentMisfit& experiment, const CsvTable& curve) {
  Chart chart{.caption = fmt::format("{} \"{}\", rms misfit {:.2g} %", experiment.fitted ? "Fit to" : "Prediction of",
                                     experiment.name, 100.0 * experiment.relative),
              .x = {.title = "time [s]"},
              .y = {.title = "strain [%]"},
              .series = {}};
  constexpr std::string_view start = "measured_strain_";
  for (const std::string& name : curve.names) {
    if (!name.starts_with(start)) continue;
    const std::string component = name.substr(start.size());
    const int colour = static_cast<int>(chart.series.size());
    const std::string shown_as = is_shear(component) ? "engineering shear " + component : component;
    chart.series.push_back({.label = "measured " + shown_as,
                            .x = curve.column("time_s"),
                            .y = plotted_strain(curve, component, "measured_"),
                            .style = SeriesStyle::points,
                            .colour = colour});
    chart.series.push_back({.label = (experiment.fitted ? "fitted " : "predicted ") + shown_as,
                            .x = curve.column("time_s"),
                            .y = plotted_strain(curve, component, "fitted_"),
                            .colour = colour + 1});
  }
  return chart;
}

}  // namespace

Table point_estimates(const FitReport& fit) {
  Table table{
      .caption = fmt::format("Fit, method {}: {}", fit.method, verdict_text(fit.found)),
      .rows = {{"parameter", "first guess", "estimate", fmt::format("{:g} % interval", 100.0 * fit.confidence)}},
      .has_header = true};
  for (const FittedParameter& p : fit.found.parameters) {
    const DisplayUnit unit =
        p.unit == "Pa" ? display_unit(p.estimate, "Pa") : DisplayUnit{.factor = 1.0, .name = p.unit};
    const auto text = [&](double value) { return shown(unit.factor * value); };
    table.rows.push_back({unit.name == "1" ? p.name : fmt::format("{} [{}]", p.name, unit.name), text(p.first_guess),
                          text(p.estimate),
                          std::isfinite(p.lower) ? fmt::format("{} to {}", text(p.lower), text(p.upper)) : "-"});
  }
  return table;
}

std::vector<PageRow> endochronic_fit_rows(const FitReport& fit, const fs::path& results) {
  std::vector<PageBlock> charts;
  for (std::size_t i = 0; i < std::min<std::size_t>(fit.experiments.size(), 4); ++i) {
    const CsvTable curve = read_csv(results / fit.experiments[i].curve);
    charts.emplace_back(channels(curve).empty() ? strain_fit_chart(fit.experiments[i], curve)
                                                : fit_chart(fit.experiments[i], curve));
  }
  return in_pairs(std::move(charts));
}

}  // namespace pfdm
