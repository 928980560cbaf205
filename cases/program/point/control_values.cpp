#include "cases/program/point/control_values.h"

#include "cases/program/input/csv_marks.h"
#include "cases/program/input/expression.h"
#include "cases/program/input/path_reader.h"
#include "cases/program/point/endochronic_loading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

double unit_of(const ConfigTable& table, std::string_view key, const Dimension& due) {
  const auto unit = table.find(key);
  return unit ? unit->in_context([&] { return unit_in_si(unit->string(), due); }) : 1.0;
}

/// The end of a name after _, as in time_s and force_kN, if it is a unit that is due.
double unit_of_name(std::string_view name, const Dimension& due) {
  const std::size_t end = name.rfind('_');
  if (end == std::string_view::npos) return 1.0;
  const std::string_view unit = name.substr(end + 1);
  const bool is_word = !unit.empty() && std::string_view("0123456789.+-").find(unit.front()) == std::string_view::npos;
  return is_word && is_unit_of(unit, due) ? unit_in_si(unit, due) : 1.0;
}

/// How many `due.si_unit` the column's unit is: as the case says, or else the file.
double unit_of_column(const ConfigTable& table, std::string_view unit_key, const CsvTable& file, std::size_t column,
                      const Dimension& due) {
  const std::string in_file = file.units.empty() || file.units[column] == "-" ? "" : file.units[column];
  if (!table.has(unit_key)) {
    if (in_file.empty()) return unit_of_name(file.names[column], due);
    return table.in_context([&] { return unit_in_si(in_file, due); });
  }
  const double factor = unit_of(table, unit_key, due);
  if (is_unit_of(in_file, due) && std::abs(unit_in_si(in_file, due) / factor - 1.0) > 1e-9)
    throw table.at(unit_key).error(
        fmt::format("the file itself says that the unit of \"{}\" is \"{}\"", file.names[column], in_file));
  return factor;
}

constexpr Range column_range{1.0, 1e6, false, "the number of a column, from 1"};

std::size_t number_of_column(const ConfigValue& name, const CsvTable& file) {
  if (name.is_string()) return name.in_context([&] { return file.find(name.string()); });
  const auto number = static_cast<std::size_t>(name.integer(column_range));
  if (number > file.names.size())
    throw name.error(fmt::format("the file has {} columns ({})", file.names.size(), fmt::join(file.names, ", ")));
  return number - 1;
}

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

void read_expression(const ConfigTable& table, bool is_stress, const std::vector<double>& times,
                     LoadSegment::Condition& condition) {
  const ConfigValue text = table.at("expr");
  if (is_stress) table.at("unit");  // a formula for a dimensional quantity comes with its unit
  const double factor = unit_of(table, "unit", dimension_of(is_stress));
  const Expression expression = text.in_context([&] { return Expression(text.string()); });
  for (const double t : times)
    condition.values.push_back(factor * text.in_context([&] { return expression(Vector::Zero(), t); }));
}

void require_range(const ConfigTable& table, const std::vector<double>& known, const std::vector<double>& times) {
  if (times.back() > known.back() * (1.0 + 1e-9))
    throw table.error(fmt::format("the segment lasts {:.6g} s, the data end at {:.6g} s", times.back(), known.back()));
}

}  // namespace

std::vector<double> read_column(const ConfigTable& table, const CsvTable& file, std::string_view column_key,
                                std::string_view unit_key, const Dimension& due) {
  const std::size_t column = number_of_column(table.at(column_key), file);
  const double factor = unit_of_column(table, unit_key, file, column, due);
  std::vector<double> values = file.columns[column];
  for (double& value : values) value *= factor;
  return values;
}

CsvTable read_csv_of(const ConfigTable& table, const std::filesystem::path& case_directory) {
  const ConfigValue name = table.at("csv");
  const std::filesystem::path file = read_data_file(name, case_directory);
  const CsvMarks marks = read_csv_marks(table);
  const CsvOptions options{
      .is_foreign = true, .separator = marks.separator, .decimal = marks.decimal, .is_unit = is_unit};
  return name.in_context([&] { return read_csv(file, options); });
}

std::vector<double> file_times(const ConfigTable& table, const std::filesystem::path& case_directory) {
  const CsvTable file = read_csv_of(table, case_directory);
  const std::string name = table.string("time", "time_s");
  const std::size_t column = table.in_context([&] { return file.find(name); });
  const double factor = unit_of_column(table, "time_unit", file, column, dimension::time);
  std::vector<double> times = file.columns[column];
  const double begin = times.front();
  for (double& t : times) t = factor * (t - begin);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw table.error(fmt::format("the times in column \"{}\" must increase; they do not at row {}", name, i + 1));
  if (times.size() < 2) throw table.error("a history needs two rows or more");
  return times;
}

void read_control_value(const ConfigValue& value, bool is_stress, const std::vector<double>& times,
                        const std::filesystem::path& case_directory, std::vector<std::filesystem::path>& files,
                        LoadSegment::Condition& condition) {
  if (!value.is_table()) {
    condition.values = {read_component_value(value, is_stress)};
    return;
  }
  const ConfigTable table =
      value.table().with_keys({"expr", "unit", "table", "csv", "column", "time", "time_unit", "separator", "decimal"});
  condition.pace = Pace::follow;
  if (table.has("expr")) return read_expression(table, is_stress, times, condition);
  Polyline line;
  if (table.has("csv")) {
    line = {file_times(table, case_directory),
            read_column(table, read_csv_of(table, case_directory), "column", "unit", dimension_of(is_stress))};
    files.push_back(case_directory / table.string("csv"));
  } else {
    line = read_table(table, is_stress);
  }
  require_range(table, line.x, times);
  follow(line, times, condition);
}

}  // namespace pfdm
