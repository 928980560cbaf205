#include "cases/program/fracture/outcome/heat_results.h"

#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

const std::vector<std::string> figure_columns{"greatest_rise_K", "mean_rise_K",   "x_m",        "y_m", "z_m",
                                              "heat_J",          "stored_heat_J", "lost_heat_J"};

}  // namespace

std::vector<std::string> with_heat_figures(std::vector<std::string> names) {
  names.insert(names.end(), figure_columns.begin(), figure_columns.end());
  return names;
}

void add_heat_figures(const HeatFigures& at, const HeatBalance& account, std::vector<double>& row) {
  row.insert(row.end(), {at.greatest, at.mean, at.place.x(), at.place.y(), at.place.z(), account.made, account.stored,
                         account.lost});
}

std::map<std::string, double> named_heat_figures(const std::string& what, std::span<const double> values) {
  std::map<std::string, double> figures;
  for (std::size_t i = 0; i < figure_columns.size(); ++i)
    figures[fmt::format("{}_{}", what, figure_columns[i])] = values[i];
  return figures;
}

std::vector<std::string> columns_of_heat() {
  std::vector<std::string> names = with_heat_figures({"step", "load", "time_s"});
  names.emplace_back("cycle_change");
  return names;
}

std::vector<double> row_of_heat(const StepReport& report) {
  std::vector<double> row{static_cast<double>(report.step), report.load, report.heat->elapsed};
  add_heat_figures(report.heat->figures, report.heat->account, row);
  row.push_back(std::min(report.heat->cycle_change, 1.0));  // a number, too, before two whole cycles
  return row;
}

std::map<std::string, double> figures_of_heat(const StepTable& table) {
  if (table.rows().empty()) return {};
  return named_heat_figures("final", std::span(table.rows().back()).subspan(3));
}

std::optional<HeadFigure> figure_of_hottest_place(const FractureCase& fracture, const RunSummary& summary) {
  if (!fracture.heat) return std::nullopt;
  const auto figure = [&](const std::string& name) { return summary.other_figure(name); };
  const double power = figure("heating_of_cycles_W");
  const bool is_long = std::isfinite(power), is_followed = follows_long_time(*fracture.heat);
  const std::string of = is_long && !is_followed ? "after_time_" : "final_";
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

}  // namespace pfdm
