#include "cases/program/fracture/page/heat_charts.h"

#include "cases/program/fracture/outcome/heat_results.h"
#include "cases/program/session/report_parts.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace pfdm {
namespace {

Chart chart_of(const CsvTable& table, const std::string& caption, const char* quantity, const char* si_unit,
               std::span<const std::string_view> columns, std::span<const std::string_view> names) {
  std::vector<std::vector<double>> values;
  for (const std::string_view column : columns) values.push_back(table.column(column));
  const std::vector<double>& time = table.column("time_s");
  const DisplayUnit x = common_unit({{time}}, "s"), y = common_unit(values, si_unit);
  Chart chart{.caption = caption,
              .x = {.title = fmt::format("time [{}]", x.name)},
              .y = {.title = fmt::format("{} [{}]", quantity, y.name)},
              .series = {}};
  add_series(chart, in_unit(time, x), values, names, y);
  return chart;
}

Chart rise_chart(const CsvTable& table, const std::string& caption) {
  static constexpr std::array<std::string_view, 2> columns{"greatest_rise_K", "mean_rise_K"}, names{"greatest", "mean"};
  return chart_of(table, caption, "temperature rise", "K", columns, names);
}

Chart heat_chart(const CsvTable& table) {
  static constexpr std::array<std::string_view, 3> columns{"heat_J", "stored_heat_J", "lost_heat_J"},
      names{"made", "stored", "lost"};
  return chart_of(table, "Heat", "heat", "J", columns, names);
}

}  // namespace

std::vector<PageBlock> heat_charts(const std::filesystem::path& results) {
  std::vector<PageBlock> charts;
  if (std::filesystem::exists(results / heat_file)) {
    const CsvTable table = read_csv(results / heat_file, {.own_names = columns_of_heat()});
    if (table.n_rows() > 0) {
      for (Chart chart : {rise_chart(table, "Temperature rise"), heat_chart(table)}) {
        for (Series& series : chart.series) series.of_steps = true;
        charts.emplace_back(std::move(chart));
      }
    }
  }
  if (std::filesystem::exists(results / heat_over_time_file))
    charts.emplace_back(
        rise_chart(read_csv(results / heat_over_time_file), "Temperature rise under the mean heat of the last cycle"));
  return charts;
}

}  // namespace pfdm
