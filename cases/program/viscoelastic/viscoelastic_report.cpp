#include "cases/program/viscoelastic/viscoelastic_report.h"

#include "cases/program/input/laws/temperature_shift_reader.h"
#include "cases/program/point/endochronic_fit_charts.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/viscoelastic/viscoelastic_fit_band.h"
#include "physics/error.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr double many_decades = 300.0;  // longest over shortest time: the axis of time is logarithmic

Table series_table(const PronyLaw& law) {
  Table table{.caption = "Prony series",
              .rows = {{"relaxed Young's modulus E", shown(law.relaxed.young_modulus(), "Pa")},
                       {"relaxed Poisson's ratio nu", shown(law.relaxed.poisson_ratio())}}};
  for (const auto& [what, branches] : {std::pair("shear", &law.shear), std::pair("bulk", &law.bulk)})
    for (const PronyBranch& branch : *branches)
      table.rows.push_back({fmt::format("{} branch: modulus, time", what),
                            fmt::format("{}, {}", shown(branch.modulus, "Pa"), shown(branch.time, "s"))});
  if (law.shift) table.rows.push_back({"temperature shift", words_of(*law.shift)});
  return table;
}

/// Keeps the rows with a positive x, which a logarithmic axis can show.
void keep_positive(std::vector<double>& x, std::vector<double>& y) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] > 0.0) x[n] = x[i], y[n++] = y[i];
  x.resize(n), y.resize(n);
}

bool spans_decades(const std::vector<double>& times) {
  const auto first = std::ranges::find_if(times, [](double t) { return t > 0.0; });
  return first != times.end() && times.back() > many_decades * *first;
}

/// Columns of a table by their label.
using Columns = std::vector<std::pair<std::string, std::string>>;

DisplayUnit unit_of_columns(const CsvTable& table, const Columns& columns, std::string_view si_unit) {
  std::vector<std::vector<double>> values;
  for (const auto& [column, label] : columns) values.push_back(table.column(column));
  return common_unit(values, si_unit);
}

/// Adds the columns over another one to the chart: points if they are measured, and none that an axis cannot show, as
/// of a loss modulus that is zero.
void add_series(const CsvTable& table, const std::string& along, const Columns& columns, const DisplayUnit& unit,
                Chart& chart) {
  for (const auto& [column, label] : columns) {
    std::vector<double> x = table.column(along), y = in_unit(table.column(column), unit);
    if (chart.x.logarithmic) keep_positive(x, y);
    if (chart.y.logarithmic) keep_positive(y, x);  // what noise has made negative
    if (x.empty()) continue;
    chart.series.push_back({.label = label,
                            .x = x,
                            .y = y,
                            .style = column.starts_with("measured") ? SeriesStyle::points : SeriesStyle::line,
                            .colour = static_cast<int>(chart.series.size())});
  }
}

/// A quantity over the time, of a column or two.
Chart over_time(const std::string& caption, const CsvTable& table, std::string_view quantity, const Columns& columns) {
  const DisplayUnit unit =
      quantity == "stress" ? unit_of_columns(table, columns, "Pa") : DisplayUnit{.factor = 100.0, .name = "%"};
  Chart chart{.caption = caption,
              .x = {.title = "time [s]", .logarithmic = spans_decades(table.column("time_s"))},
              .y = {.title = fmt::format("{} [{}]", quantity, unit.name)},
              .series = {}};
  add_series(table, "time_s", columns, unit, chart);
  return chart;
}

constexpr const char* reduced_frequency = "frequency at the reference temperature [Hz]";

/// Moduli [Pa], or loss factors, over the frequency.
Chart over_frequency(const std::string& caption, const CsvTable& table, bool moduli, const Columns& columns) {
  const DisplayUnit unit = moduli ? unit_of_columns(table, columns, "Pa") : DisplayUnit{.factor = 1.0, .name = "1"};
  const bool is_master = std::ranges::count(table.names, "reduced_frequency_Hz") > 0;
  Chart chart{
      .caption = caption,
      .x = {.title = is_master ? reduced_frequency : "frequency [Hz]", .logarithmic = true},
      .y = {.title = moduli ? fmt::format("modulus [{}]", unit.name) : "loss factor [1]", .logarithmic = moduli},
      .series = {}};
  add_series(table, is_master ? "reduced_frequency_Hz" : "frequency_Hz", columns, unit, chart);
  return chart;
}

std::vector<PageRow> rows_of_run(const ViscoelasticCase& c, const fs::path& results) {
  std::vector<PageBlock> charts;
  if (c.loading) {
    const CsvTable history = read_csv(results / "history.csv");
    const std::string_view of = c.loading->deformation == Deformation::shear ? "shear " : "";
    charts.emplace_back(over_time(fmt::format("{}strain over time", of), history, "strain", {{"strain", ""}}));
    charts.emplace_back(over_time(fmt::format("{}stress over time", of), history, "stress", {{"stress_Pa", ""}}));
  }
  if (c.sweep) {
    const CsvTable moduli = read_csv(results / "complex_modulus.csv");
    charts.emplace_back(over_frequency("Complex moduli", moduli, true,
                                       {{"young_storage_modulus_Pa", "E'"},
                                        {"young_loss_modulus_Pa", "E''"},
                                        {"shear_storage_modulus_Pa", "G'"},
                                        {"shear_loss_modulus_Pa", "G''"}}));
    charts.emplace_back(over_frequency("Loss factors", moduli, false,
                                       {{"young_loss_factor", "tension"}, {"shear_loss_factor", "shear"}}));
  }
  return in_pairs(std::move(charts));
}

/// The columns of a fitted curve with one of these quantities, measured and fitted side by side.
Columns pairs_of(const CsvTable& curve, std::initializer_list<std::string_view> quantities) {
  Columns columns;
  for (const std::string_view quantity : quantities)
    for (const char* what : {"measured", "fitted"})
      for (const std::string& name : curve.names)
        if (name.starts_with(fmt::format("{}_{}", what, quantity))) {
          std::string words(quantity);
          std::ranges::replace(words, '_', ' ');
          columns.emplace_back(name, fmt::format("{} {}", what, words));
        }
  return columns;
}

/// Ends of intervals that a logarithmic axis can show: the data may allow a loss modulus of zero, or any.
std::vector<double> shown_end(const CsvTable& table, const std::string& end, const std::string& column) {
  constexpr double farthest = 10.0;
  std::vector<double> ends = table.column(end + column);
  const std::vector<double>& values = table.column(column);
  for (std::size_t i = 0; i < ends.size(); ++i)
    ends[i] = std::clamp(ends[i], values[i] / farthest, values[i] * farthest);
  return ends;
}

/// Storage and loss modulus of the fit, "young" or "shear", with their 95 % bands where they are known.
Chart moduli_of_fit(const CsvTable& table, const std::string& which, const std::string& letter, bool is_shifted) {
  const std::string storage = which + "_storage_modulus_Pa", loss = which + "_loss_modulus_Pa";
  Columns columns{{storage, letter + "'"}, {loss, letter + "''"}};
  const bool is_known = std::ranges::count(table.names, "lower_" + storage) > 0;
  Chart chart =
      over_frequency(is_known ? "Complex modulus of the fit, 95 % bands (to a tenth and ten times of it at most)"
                              : "Complex modulus of the fit",
                     table, true, columns);
  if (is_shifted) chart.x.title = reduced_frequency;
  const DisplayUnit unit = unit_of_columns(table, columns, "Pa");
  for (int k = 0; is_known && k < 2; ++k) {
    const std::string& column = columns[static_cast<std::size_t>(k)].first;
    if (!(std::ranges::min(table.column(column)) > 0.0)) continue;
    chart.series.push_back({.label = "",
                            .x = table.column("frequency_Hz"),
                            .y = in_unit(shown_end(table, "lower_", column), unit),
                            .style = SeriesStyle::band,
                            .colour = k,
                            .upper = in_unit(shown_end(table, "upper_", column), unit)});
  }
  return chart;
}

std::vector<PageRow> rows_of_fit(const FitReport& fit, const fs::path& results, bool is_shifted) {
  std::vector<PageBlock> charts;
  for (const ExperimentMisfit& test : fit.experiments) {
    const CsvTable curve = read_csv(results / test.curve);
    const std::string caption = fmt::format("Fit to \"{}\", rms misfit {:.2g} %", test.name, 100.0 * test.relative);
    for (const char* quantity : {"stress", "strain"})
      if (const auto columns = pairs_of(curve, {quantity}); !columns.empty())
        charts.emplace_back(over_time(caption, curve, quantity, columns));
    if (const auto columns = pairs_of(curve, {"storage_modulus", "loss_modulus"}); !columns.empty())
      charts.emplace_back(over_frequency(caption, curve, true, columns));
    if (const auto columns = pairs_of(curve, {"loss_factor"}); !columns.empty())
      charts.emplace_back(over_frequency(caption, curve, false, columns));
  }
  if (const fs::path file = results / modulus_band_file; fs::exists(file)) {
    const CsvTable moduli = read_csv(file, {.has_gaps = true});  // ends may be inf
    charts.emplace_back(moduli_of_fit(moduli, "young", "E", is_shifted));
    charts.emplace_back(moduli_of_fit(moduli, "shear", "G", is_shifted));
  }
  return in_pairs(std::move(charts));
}

}  // namespace

ReportPage viscoelastic_page(const ViscoelasticCase& c, const std::string& name, const std::string& hash,
                             const fs::path& results) {
  const auto run = find_of_case(results / summary_file, hash, read_run_summary);
  const auto fit = find_of_case(results / "fit.json", hash, read_fit_json);
  if (!run && !fit) throw InputError(fmt::format("{}: there are no results; pfdm run makes them", results.string()));
  ReportPage page{
      .title = fmt::format("{}: {}", name, c.title),
      .subtitle = fmt::format("case {}, {}", hash, run ? fit ? "run and fitted" : "run" : "fitted, not run"),
      .rows = {}};
  PageRow tables{.blocks = {series_table(c.law)}};
  if (fit) tables.blocks.emplace_back(point_estimates(*fit));
  page.rows.push_back(std::move(tables));
  if (run)
    for (PageRow& row : rows_of_run(c, results)) page.rows.push_back(std::move(row));
  if (fit)
    for (PageRow& row : rows_of_fit(*fit, results, c.law.shift.has_value())) page.rows.push_back(std::move(row));
  for (const char* log : {"run.log", "fit.log"})
    for (PageRow& row : warnings_row(results / log)) page.rows.push_back(std::move(row));
  return page;
}

std::vector<std::string> viscoelastic_headline(const std::string& hash, const fs::path& results) {
  const auto run = find_of_case(results / summary_file, hash, read_run_summary);
  if (!run) return {};
  const auto shown_of = [&](const char* name, const char* unit) { return shown(run->other_figure(name), unit); };
  std::vector<std::string> sentences{fmt::format("Young's modulus {} relaxed, {} at once.",
                                                 shown_of("relaxed_young_modulus_Pa", "Pa"),
                                                 shown_of("instantaneous_young_modulus_Pa", "Pa"))};
  if (run->other_figures.contains("largest_stress_Pa"))
    sentences.push_back(fmt::format("Largest stress {}; at the end {} at a strain of {:.4g} %.",
                                    shown_of("largest_stress_Pa", "Pa"), shown_of("final_stress_Pa", "Pa"),
                                    100.0 * run->other_figure("final_strain")));
  if (run->other_figures.contains("largest_shear_loss_factor"))
    sentences.push_back(fmt::format("Largest loss factor in shear {:.4g} at {}.",
                                    run->other_figure("largest_shear_loss_factor"),
                                    shown_of("largest_shear_loss_factor_at_Hz", "Hz")));
  return sentences;
}

}  // namespace pfdm
