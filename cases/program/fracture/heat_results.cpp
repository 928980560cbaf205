#include "cases/program/fracture/heat_results.h"

#include "physics/quantity_text.h"
#include "postproc/fields/vtu_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

const std::vector<std::string> figure_columns{"greatest_rise_K", "mean_rise_K",   "x_m",        "y_m", "z_m",
                                              "heat_J",          "stored_heat_J", "lost_heat_J"};

std::vector<std::string> with_figures(std::vector<std::string> names) {
  names.insert(names.end(), figure_columns.begin(), figure_columns.end());
  return names;
}

void add_figures(const HeatFigures& at, const HeatBalance& account, std::vector<double>& row) {
  row.insert(row.end(), {at.greatest, at.mean, at.place.x(), at.place.y(), at.place.z(), account.made, account.stored,
                         account.lost});
}

/// Over the summary's names `what`_NAME.
std::map<std::string, double> named(const std::string& what, std::span<const std::string> names,
                                    std::span<const double> values) {
  std::map<std::string, double> figures;
  for (std::size_t i = 0; i < names.size(); ++i) figures[fmt::format("{}_{}", what, names[i])] = values[i];
  return figures;
}

void warn_of_cycles(RunningCase& c) {
  const HeatModel& model = c.program.fracture.heat->model;
  if (!(model.cycle > 0.0) || c.state.heat.cycle_change <= model.repeats_within || !c.run.is_complete(c.state)) return;
  c.session.log.warn(
      fmt::format("the heat of the last cycle of load differs by {:.2g} % from that of the one before, more than "
                  "heat.repeats_within: go through more cycles (loading.end = {:g})",
                  100.0 * c.state.heat.cycle_change, c.program.fracture.loading.end + 4.0 * model.cycle));
}

void write_rows(const RunningCase& c, const std::vector<HeatRow>& rows) {
  StepTable table(c.results.folder() / heat_over_time_file, with_figures({"step", "time_s"}), std::nullopt);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<double> row{static_cast<double>(i), rows[i].time};
    add_figures(rows[i].figures, rows[i].account, row);
    table.append(std::move(row), false);
  }
  table.write();
}

void write_field(const RunningCase& c, const CellField<double>& rise, double cycle_time, double time) {
  CellField<double> heating = c.state.heat.cycle;
  for (Index i = 0; i < heating.size(); ++i) heating[i] /= c.mesh.cell_volume[i] * cycle_time;
  VtuWriter(c.mesh, {.time_unit = "s"})
      .write(c.results.folder() / heated_file,
             {{"temperature_rise", &rise, Precision::double_precision, "K"},
              {"heating", &heating, Precision::double_precision, "W/m^3"},
              {"material", &c.mesh.region}},
             time);
}

}  // namespace

std::vector<std::string> columns_of_heat() {
  std::vector<std::string> names = with_figures({"step", "load", "time_s"});
  names.emplace_back("cycle_change");
  return names;
}

std::vector<double> row_of_heat(const StepReport& report, double duration) {
  std::vector<double> row{static_cast<double>(report.step), report.load, report.load * duration};
  add_figures(report.heat->figures, report.heat->account, row);
  row.push_back(std::min(report.heat->cycle_change, 1.0));  // a number, too, before two whole cycles
  return row;
}

std::map<std::string, double> figures_of_heat(const StepTable& table) {
  if (table.rows().empty()) return {};
  return named("final", figure_columns, std::span(table.rows().back()).subspan(3));
}

std::optional<HeadFigure> figure_of_hottest_place(const FractureCase& fracture, const RunSummary& summary) {
  if (!fracture.heat) return std::nullopt;
  const auto figure = [&](const std::string& name) { return summary.other_figure(name); };
  const double power = figure("heating_of_cycles_W");
  const bool is_long = std::isfinite(power);
  const std::string of = is_long ? "after_time_" : "final_";
  const double rise = figure(of + "greatest_rise_K");
  if (!(rise > 0.0)) return std::nullopt;
  return HeadFigure{
      .label = "Greatest temperature rise",
      .value = quantity_text(rise, "K", 3),
      .note = fmt::format("{}, at {}; {} in the mean{}",
                          is_long ? fmt::format("after {:g} s", fracture.heat->time) : "after the last step",
                          point_text(figure(of + "x_m"), figure(of + "y_m"), figure(of + "z_m")),
                          quantity_text(figure(of + "mean_rise_K"), "K", 3),
                          is_long ? fmt::format(", from a heating of {}", quantity_text(power, "W", 3)) : "")};
}

std::map<std::string, double> heat_at_the_end(RunningCase& c) {
  warn_of_cycles(c);
  const HeatSettings& heat = *c.program.fracture.heat;
  if (!(heat.time > 0.0) || c.state.heat.cycle.size() == 0 || !c.run.is_complete(c.state)) return {};
  CellField<double> rise;
  const std::vector<HeatRow> rows = c.run.warm_by_cycles(c.state, heat.time, heat.time_steps, rise);
  const HeatRow& end = rows.back();
  const double cycle_time = heat.model.cycle * c.state.heat.duration;
  const double power = std::accumulate(c.state.heat.cycle.begin(), c.state.heat.cycle.end(), 0.0) / cycle_time;
  write_rows(c, rows);
  if (!c.session.figures_only) write_field(c, rise, cycle_time, heat.time);
  c.session.log.say(
      fmt::format("heat: {:.4g} W, the mean of the last cycle, warm the body in {:g} s by at most {:.4g} K, at {}, and "
                  "by {:.4g} K in the mean{} ({}, {})",
                  power, heat.time, end.figures.greatest, point_text(end.figures.place), end.figures.mean,
                  end.account.made > 0.0
                      ? fmt::format("; {:.3g} % of the heat has left it", 100.0 * end.account.lost / end.account.made)
                      : "",
                  heat_over_time_file, heated_file));
  std::vector<double> figures;
  add_figures(end.figures, end.account, figures);
  std::map<std::string, double> result = named("after_time", figure_columns, figures);
  result["heating_of_cycles_W"] = power;
  return result;
}

}  // namespace pfdm
