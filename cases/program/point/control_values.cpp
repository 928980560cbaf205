#include "cases/program/point/control_values.h"

#include "cases/program/input/config/expression.h"
#include "cases/program/input/fields/csv_columns.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "cases/program/point/endochronic_loading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

struct Polyline {
  std::vector<double> x, y;
};

double interpolate(const Polyline& line, double x) {
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(line.x, x) - line.x.begin());
  if (above == 0) return line.y.front();
  if (above == line.x.size()) return line.y.back();
  const double w = (x - line.x[above - 1]) / (line.x[above] - line.x[above - 1]);
  return (1.0 - w) * line.y[above - 1] + w * line.y[above];
}

const Dimension& dimension_of(bool is_stress) { return is_stress ? dimension::stress : dimension::number; }

void follow(const Polyline& line, const std::vector<double>& times, LoadSegment::Condition& condition) {
  for (const double t : times) condition.values.push_back(interpolate(line, t));
}

Polyline read_table(const ConfigTable& table, bool is_stress) {
  Polyline line;
  for (const ConfigValue& point : table.at("table").list()) {
    const auto pair = point.list(2);
    line.x.push_back(pair[0].quantity(dimension::time, range::not_negative));
    line.y.push_back(read_component_value(pair[1], is_stress));
    if (line.x.size() > 1 && !(line.x.back() > line.x[line.x.size() - 2]))
      throw pair[0].error("the times must increase");
  }
  if (line.x.empty()) throw table.error("\"table\" has no points, as in [[\"0 s\", 0], [\"1 s\", 0.01]]");
  return line;
}

Polyline read_polyline(const ConfigTable& table, bool is_stress, const std::filesystem::path& case_directory) {
  const CsvTable file = read_csv_of(table, case_directory);
  Polyline line{.x = read_times(table, file), .y = read_column(table, file, "column", "unit", dimension_of(is_stress))};
  leave_out_gaps(table, std::array{&line.x, &line.y});
  begin_at_zero(table, line.x);
  return line;
}

void read_expression(const ConfigTable& table, bool is_stress, const std::vector<double>& times,
                     LoadSegment::Condition& condition) {
  const ConfigValue text = table.at("expr");
  if (is_stress) table.at("unit");  // a formula for a dimensional quantity comes with its unit
  const double factor = read_unit(table, "unit", dimension_of(is_stress));
  const Expression expression = text.in_context([&] { return Expression(text.string()); });
  for (const double t : times)
    condition.values.push_back(factor * text.in_context([&] { return expression(Vector::Zero(), t); }));
}

void require_range(const ConfigTable& table, const std::vector<double>& known, const std::vector<double>& times) {
  if (times.back() > known.back() * (1.0 + 1e-9))
    throw table.error(fmt::format("the segment lasts {:.6g} s, the data end at {:.6g} s", times.back(), known.back()));
}

}  // namespace

void read_control_value(const ConfigValue& value, bool is_stress, const std::vector<double>& times,
                        const std::filesystem::path& case_directory, std::vector<std::filesystem::path>& files,
                        LoadSegment::Condition& condition) {
  if (!value.is_table()) {
    condition.values = {read_component_value(value, is_stress)};
    return;
  }
  const ConfigTable table = value.table().with_keys(control_value_keys());
  condition.pace = Pace::follow;
  if (table.has("expr")) return read_expression(table, is_stress, times, condition);
  Polyline line;
  if (table.has("csv")) {
    line = read_polyline(table, is_stress, case_directory);
    files.push_back(case_directory / table.string("csv"));
  } else {
    line = read_table(table, is_stress);
  }
  require_range(table, line.x, times);
  follow(line, times, condition);
}

std::vector<double> control_times(const ConfigTable& table, const std::filesystem::path& case_directory) {
  const CsvTable file = read_csv_of(table, case_directory);
  std::vector<double> times = read_times(table, file);
  leave_out_gaps(table, std::array{&times});
  begin_at_zero(table, times);
  return times;
}

}  // namespace pfdm
