#include "cases/program/fracture/page/posterior_charts.h"

#include "cases/program/session/report_parts.h"
#include "postproc/files/csv_table.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr std::size_t most_parameters = 4, most_points = 1000;
constexpr int n_bins = 40;

/// A parameter's samples in a unit that fits, with the title of an axis.
struct Samples {
  std::string title;
  std::vector<double> values;
};

Samples samples_of(const CsvTable& table, const FittedParameter& p) {
  const std::vector<double>& si = table.column(p.name);
  if (p.unit.empty() || p.unit == "1") return {p.name, si};
  if (p.unit.find('/') != std::string::npos) return {fmt::format("{} [{}]", p.name, p.unit), si};
  const DisplayUnit unit = common_unit({{si}}, p.unit);
  return {fmt::format("{} [{}]", p.name, unit.name), in_unit(si, unit)};
}

/// Over a density of 1 at its highest.
Chart density_chart(const Samples& samples) {
  const auto [least, most] = std::ranges::minmax(samples.values);
  const double width = std::max(most - least, 1e-300) / n_bins;
  std::vector<double> counts(n_bins, 0.0);
  for (const double value : samples.values)
    counts[std::min<std::size_t>(n_bins - 1, static_cast<std::size_t>((value - least) / width))] += 1.0;
  const double highest = std::ranges::max(counts);
  Series series{.label = "", .x = {least}, .y = {0.0}};
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (const double side : {0.0, 1.0}) {
      series.x.push_back(least + width * (static_cast<double>(i) + side));
      series.y.push_back(counts[i] / highest);
    }
  series.x.push_back(most);
  series.y.push_back(0.0);
  return {.caption = fmt::format("Posterior of {}", samples.title),
          .x = {.title = samples.title},
          .y = {.title = "density over its highest", .from = 0.0},
          .series = {std::move(series)}};
}

Chart pair_chart(const Samples& a, const Samples& b) {
  Series series{.label = "", .x = {}, .y = {}, .style = SeriesStyle::points};
  const std::size_t step = std::max<std::size_t>(1, a.values.size() / most_points);
  for (std::size_t i = 0; i < a.values.size(); i += step) {
    series.x.push_back(a.values[i]);
    series.y.push_back(b.values[i]);
  }
  return {
      .caption = "Posterior: samples", .x = {.title = a.title}, .y = {.title = b.title}, .series = {std::move(series)}};
}

/// 95 % of the posterior, and a line with it.
std::vector<Series> line_with_band(std::string label, const std::vector<double>& x, std::vector<double> line,
                                   std::vector<double> lower, std::vector<double> upper) {
  return {{.label = "95 % of the posterior",
           .x = x,
           .y = std::move(lower),
           .style = SeriesStyle::band,
           .colour = 7,
           .upper = std::move(upper)},
          {.label = std::move(label), .x = x, .y = std::move(line), .colour = 0}};
}

Chart law_chart(const CsvTable& table) {
  const std::vector<double>&s = table.column("separation_m"), &estimate = table.column("traction_Pa"),
        &lower = table.column("lower_traction_Pa"), &upper = table.column("upper_traction_Pa");
  const DisplayUnit x = common_unit({{s}}, "m"), y = common_unit({{estimate, upper}}, "Pa");
  const std::vector<double> at = in_unit(s, x);
  const std::string& comment = table.comments.front();  // law of "NAME" in opening: ...
  const std::size_t end = comment.find(" in opening");
  return {.caption = fmt::format("L{} in opening, with its posterior", comment.substr(1, end - 1)),
          .x = {.title = fmt::format("separation [{}]", x.name), .from = 0.0},
          .y = {.title = fmt::format("traction [{}]", y.name), .from = 0.0},
          .series = line_with_band("estimates", at, in_unit(estimate, y), in_unit(lower, y), in_unit(upper, y))};
}

Chart discrepancy_chart(const CsvTable& table) {
  const std::vector<double>&at = table.column("displacement_m"), &median = table.column("median_force_N"),
        &lower = table.column("lower_force_N"), &upper = table.column("upper_force_N");
  const DisplayUnit x = common_unit({{at}}, "m"), y = common_unit({{lower, upper}}, "N");
  const std::vector<double> places = in_unit(at, x);
  return {.caption = "What the model lacks: measured less computed force, by the posterior",
          .x = {.title = fmt::format("displacement [{}]", x.name)},
          .y = {.title = fmt::format("force [{}]", y.name)},
          .series = line_with_band("median", places, in_unit(median, y), in_unit(lower, y), in_unit(upper, y))};
}

}  // namespace

std::vector<Chart> posterior_charts(const FitReport& fit, const std::filesystem::path& results) {
  std::vector<Chart> charts;
  for (const std::string& file : fit.found.posterior->law_files) charts.push_back(law_chart(read_csv(results / file)));
  if (const auto& discrepancy = fit.found.posterior->discrepancy)
    charts.push_back(discrepancy_chart(read_csv(results / discrepancy->file)));
  const CsvTable table = read_csv(results / fit.found.posterior->file);
  std::vector<Samples> samples;
  for (const FittedParameter& p : fit.found.parameters)
    if (p.posterior && samples.size() < most_parameters) samples.push_back(samples_of(table, p));
  for (const Samples& of : samples) charts.push_back(density_chart(of));
  for (std::size_t j = 0; j < samples.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) charts.push_back(pair_chart(samples[i], samples[j]));
  return charts;
}

}  // namespace pfdm
