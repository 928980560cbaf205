#include "cases/program/point/endochronic_report.h"

#include "cases/program/point/endochronic_fit_charts.h"
#include "cases/program/point/plotted_strain.h"
#include "cases/program/session/report_parts.h"
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
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr double least_share = 1e-3;  // of the largest stress, for a component to be shown
struct StoredRun {
  RunSummary summary;
  CsvTable history;
};

std::optional<StoredRun> find_run(const fs::path& results, const std::string& hash) {
  const auto summary = find_of_case(results / summary_file, hash, read_run_summary);
  if (!summary) return std::nullopt;
  return StoredRun{.summary = *summary, .history = read_csv(results / "history.csv")};
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

std::string stress_name(std::string_view component) { return fmt::format("stress_{}_Pa", component); }

/// Components whose stress is not small beside the largest.
std::vector<std::string_view> stressed(const CsvTable& history) {
  double most = 0.0;
  for (const std::string_view c : component_names) most = std::max(most, largest(history.column(stress_name(c))));
  std::vector<std::string_view> components;
  for (const std::string_view c : component_names)
    if (most > 0.0 && largest(history.column(stress_name(c))) > least_share * most) components.push_back(c);
  return components;
}

/// Whether a segment prescribes the component k of stress (true) or strain.
bool prescribes(const LoadSegment& segment, int k, bool is_stress) {
  return std::ranges::any_of(segment.conditions, [&](const LoadSegment::Condition& due) {
    return (is_stress ? due.condition.on_stress : due.condition.on_strain)[k] != 0.0;
  });
}

/// Of stress (true) or strain, those that the loading prescribes at some time.
std::vector<std::string_view> prescribed(const EndochronicLoading& loading, bool is_stress) {
  std::vector<std::string_view> components;
  for (int k = 0; k < n_components; ++k)
    if (std::ranges::any_of(loading.segments, [&](const auto& segment) { return prescribes(segment, k, is_stress); }))
      components.push_back(component_names[k]);
  return components;
}

/// Leaves of a component's history the parts that are prescribed; a history has a point for each increment.
void blank_what_is_free(std::vector<double>& values, const EndochronicLoading& loading, std::string_view component,
                        bool is_stress) {
  const auto k = static_cast<int>(std::ranges::find(component_names, component) - component_names.begin());
  std::vector<bool> kept(values.size(), false);
  std::size_t start = 0;
  for (const LoadSegment& segment : loading.segments) {
    const std::size_t end = start + segment.times.size() - 1;
    if (prescribes(segment, k, is_stress))
      for (std::size_t i = start; i <= std::min(end, values.size() - 1); ++i) kept[i] = true;
    start = end;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!kept[i]) values[i] = std::nan("");
}

Table parameter_table(const EndochronicLaw& law) {
  Table table{.caption = "Parameters",
              .rows = {{"Young's modulus E", shown(law.elasticity.young_modulus(), "Pa")},
                       {"Poisson's ratio nu", shown(law.elasticity.poisson_ratio())}}};
  for (const KernelTerm& term : law.kernel)
    table.rows.push_back({"kernel: C, alpha", fmt::format("{}, {}", shown(term.C, "Pa"), shown(term.alpha))});
  for (const auto& [what, factor] :
       {std::pair("hardening", law.hardening.with_path), std::pair("rate factor", law.hardening.with_rate)}) {
    std::string text(factor.law->name);
    for (std::size_t i = 0; !factor.law->tabulated && i < factor.p.size(); ++i) {
      const LawParameter& due = factor.law->parameters[i];
      text +=
          fmt::format(", {} = {}{}", due.name, shown(factor.p[i]), due.unit == "1" ? "" : fmt::format(" {}", due.unit));
    }
    table.rows.push_back({what, text});
  }
  return table;
}

Table figures_table(const RunSummary& summary) {
  Table table{.caption = "Run", .rows = {{"increments", fmt::format("{}", summary.steps)}}};
  const auto add = [&](const char* what, const char* name, auto&& text) {
    const auto found = summary.other_figures.find(name);
    if (found != summary.other_figures.end()) table.rows.push_back({what, text(found->second)});
  };
  const auto plain = [](double v) { return shown(v); };
  add("duration", "final_time_s", [](double v) { return shown(v, "s"); });
  add("largest von Mises stress", "largest_von_mises_stress_Pa", [](double v) { return shown(v, "Pa"); });
  add("path length zeta", "final_zeta", plain);
  add("intrinsic time z", "final_z", plain);
  add("work", "external_work_J_per_m3", [](double v) { return shown(v, "J") + "/m³"; });
  add("dissipation", "dissipation_J_per_m3", [](double v) { return shown(v, "J") + "/m³"; });
  add("energy balance error", "energy_balance_error", [](double v) { return fmt::format("{:.2g} %", 100.0 * v); });
  add("Newton iterations", "newton_iterations", plain);
  table.rows.push_back({"time", fmt::format("{:.3g} s wall", summary.wall_seconds)});
  return table;
}

Chart loop_chart(const CsvTable& history, std::string_view component) {
  const std::vector<double>& stress = history.column(stress_name(component));
  const DisplayUnit unit = common_unit({{stress}}, "Pa");
  return {.caption = fmt::format("Stress against strain, {}", component),
          .x = {.title = strain_title(component)},
          .y = {.title = fmt::format("stress {} [{}]", component, unit.name)},
          .series = {{.label = {}, .x = plotted_strain(history, component), .y = in_unit(stress, unit)}}};
}

Chart strain_chart(const CsvTable& history, const std::vector<std::string_view>& components) {
  Chart chart{.caption = "Prescribed strains", .x = {.title = "time [s]"}, .y = {.title = "strain [%]"}, .series = {}};
  for (const std::string_view c : components)
    chart.series.push_back({.label = is_shear(c) ? fmt::format("engineering shear {}", c) : std::string(c),
                            .x = history.column("time_s"),
                            .y = plotted_strain(history, c),
                            .colour = static_cast<int>(chart.series.size())});
  return chart;
}

Chart stress_chart(const std::string& caption, const CsvTable& history,
                   const std::vector<std::string_view>& components) {
  std::vector<std::vector<double>> columns;
  columns.reserve(components.size());
  for (const std::string_view c : components) columns.push_back(history.column(stress_name(c)));
  const DisplayUnit unit = common_unit(columns, "Pa");
  Chart chart{.caption = caption,
              .x = {.title = "time [s]"},
              .y = {.title = fmt::format("stress [{}]", unit.name)},
              .series = {}};
  add_series(chart, history.column("time_s"), columns, components, unit);
  return chart;
}

Chart energy_chart(const CsvTable& history) {
  const std::vector<std::vector<double>> energies{history.column("external_work_J_per_m3"),
                                                  history.column("free_energy_J_per_m3"),
                                                  history.column("dissipation_J_per_m3")};
  const DisplayUnit unit = common_unit(energies, "J");
  Chart chart{.caption = "Energies by volume",
              .x = {.title = "time [s]"},
              .y = {.title = fmt::format("energy [{}/m³]", unit.name)},
              .series = {}};
  constexpr std::string_view names[] = {"work", "free energy", "dissipation"};
  add_series(chart, history.column("time_s"), energies, names, unit);
  return chart;
}

std::vector<PageRow> run_rows(const EndochronicCase& point, const CsvTable& history) {
  std::vector<std::string_view> loops = stressed(history);
  if (loops.size() > 2) loops.resize(2);
  const std::vector<std::string_view> strains = prescribed(point.loading, false);
  std::vector<std::string_view> stresses = prescribed(point.loading, true);
  const auto shown_ones = stressed(history);
  std::erase_if(stresses, [&](std::string_view c) { return std::ranges::find(shown_ones, c) == shown_ones.end(); });
  PageRow first{.blocks = {}, .height = 1.3}, second{.blocks = {}};
  for (const std::string_view c : loops) first.blocks.emplace_back(loop_chart(history, c));
  if (!strains.empty()) {
    Chart chart = strain_chart(history, strains);
    for (std::size_t i = 0; i < strains.size(); ++i)
      blank_what_is_free(chart.series[i].y, point.loading, strains[i], false);
    second.blocks.emplace_back(std::move(chart));
  }
  if (!stresses.empty()) {
    Chart chart = stress_chart("Prescribed stresses", history, stresses);
    for (std::size_t i = 0; i < stresses.size(); ++i)
      blank_what_is_free(chart.series[i].y, point.loading, stresses[i], true);
    second.blocks.emplace_back(std::move(chart));
  }
  second.blocks.emplace_back(energy_chart(history));
  if (first.blocks.size() == 1) first.blocks.emplace_back(stress_chart("Stress over time", history, loops));
  if (first.blocks.empty()) return {second};
  return {first, second};
}

}  // namespace

ReportPage endochronic_page(const EndochronicCase& point, const std::string& name, const std::string& hash,
                            const fs::path& results) {
  const std::optional<StoredRun> run = find_run(results, hash);
  const auto fit = find_of_case(results / "fit.json", hash, read_fit_json);
  if (!run && !fit) throw InputError(fmt::format("{}: there are no results; pfdm run makes them", results.string()));
  ReportPage page{
      .title = fmt::format("{}: {}", name, point.title),
      .subtitle = run ? fmt::format("pfdm {}, case {}, run {}", run->summary.version, hash, run->summary.status)
                      : fmt::format("pfdm {}, case {}, fitted, not run", fit->version, hash),
      .rows = {}};
  PageRow tables{.blocks = {parameter_table(point.law)}};
  if (run) tables.blocks.emplace_back(figures_table(run->summary));
  if (fit) tables.blocks.emplace_back(point_estimates(*fit));
  page.rows.push_back(std::move(tables));
  if (run)
    for (PageRow& row : run_rows(point, run->history)) page.rows.push_back(std::move(row));
  if (fit)
    for (PageRow& row : endochronic_fit_rows(*fit, results)) page.rows.push_back(std::move(row));
  for (const char* log : {"run.log", "fit.log"})
    for (PageRow& row : warnings_row(results / log)) page.rows.push_back(std::move(row));
  return page;
}

std::vector<std::string> endochronic_headline(const std::string& hash, const fs::path& results) {
  const auto summary = find_of_case(results / summary_file, hash, read_run_summary);
  if (!summary || summary->status != "complete") return {};
  return history_sentences(summary->other_figures);
}

}  // namespace pfdm
