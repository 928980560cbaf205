#include "cases/program/input/fields/csv_columns.h"

#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/csv_marks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// How many `due.si_unit` the column's unit is: as the case says, or else the file.
double unit_of_column(const ConfigTable& table, std::string_view unit_key, const CsvTable& file, std::size_t column,
                      const Dimension& due) {
  const std::string in_file = file.units.empty() || file.units[column] == "-" ? "" : file.units[column];
  if (!table.has(unit_key)) {
    if (in_file.empty()) {
      const std::string_view unit = unit_of_name(file.names[column], due);
      return unit.empty() ? 1.0 : unit_in_si(unit, due);
    }
    return table.in_context([&] { return unit_in_si(in_file, due); });
  }
  const double factor = read_unit(table, unit_key, due);
  if (is_unit_of(in_file, due) && std::abs(unit_in_si(in_file, due) / factor - 1.0) > 1e-9)
    throw table.at(unit_key).error(
        fmt::format("the file itself says that the unit of \"{}\" is \"{}\"", file.names[column], in_file));
  return factor;
}

constexpr Range column_range{1.0, 1e6, false, "the number of a column, from 1"};

}  // namespace

std::string_view unit_of_name(std::string_view name, const Dimension& due) {
  const std::size_t end = name.rfind('_');
  if (end == std::string_view::npos) return {};
  const std::string_view unit = name.substr(end + 1);
  const bool is_word = !unit.empty() && std::string_view("0123456789.+-").find(unit.front()) == std::string_view::npos;
  return is_word && is_unit_of(unit, due) ? unit : std::string_view();
}

std::size_t find_column(const ConfigValue& name, const CsvTable& file) {
  if (name.is_string()) return name.in_context([&] { return file.find(name.string()); });
  const auto number = static_cast<std::size_t>(name.integer(column_range));
  if (number > file.names.size())
    throw name.error(fmt::format("the file has {} columns{}", file.names.size(),
                                 file.has_names() ? fmt::format(" ({})", fmt::join(file.names, ", ")) : ""));
  return number - 1;
}

double read_unit(const ConfigTable& table, std::string_view key, const Dimension& due) {
  const auto unit = table.find(key);
  return unit ? unit->in_context([&] { return unit_in_si(unit->string(), due); }) : 1.0;
}

std::vector<double> read_column(const ConfigTable& table, const CsvTable& file, std::string_view column_key,
                                std::string_view unit_key, const Dimension& due) {
  const std::size_t column = find_column(table.at(column_key), file);
  table.at(column_key).in_context([&] { file.require_numbers(column); });
  const double factor = unit_of_column(table, unit_key, file, column, due);
  std::vector<double> values = file.columns[column];
  for (double& value : values) value *= factor;
  return values;
}

CsvTable read_csv_of(const ConfigTable& table, const std::filesystem::path& case_directory) {
  const ConfigValue name = table.at("csv");
  const std::filesystem::path file = read_data_file(name, case_directory);
  const CsvOptions options{.is_foreign = true, .marks = read_csv_marks(table), .is_unit = is_unit};
  return name.in_context([&] { return read_csv(file, options); });
}

void leave_out_gaps(const ConfigTable& table, std::span<std::vector<double>* const> columns) {
  const std::size_t n = columns.front()->size();
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < n; ++i)
    if (std::ranges::none_of(columns, [i](const auto* column) { return std::isnan((*column)[i]); })) kept.push_back(i);
  if (kept.size() == n) return;
  const ConfigValue csv = table.at("csv");
  if (kept.empty()) throw csv.error(fmt::format("each of its {} rows has an empty entry in a column that is used", n));
  for (std::vector<double>* column : columns) {
    for (std::size_t i = 0; i < kept.size(); ++i) (*column)[i] = (*column)[kept[i]];
    column->resize(kept.size());
  }
  csv.remark(fmt::format("{} of {} rows left out: an entry of a column that is used is empty", n - kept.size(), n));
}

std::vector<double> read_times(const ConfigTable& table, const CsvTable& file) {
  const std::string name = table.string("time", "time_s");
  const std::size_t column = table.in_context([&] {
    const std::size_t found = file.find(name);
    file.require_numbers(found);
    return found;
  });
  const double factor = unit_of_column(table, "time_unit", file, column, dimension::time);
  std::vector<double> times = file.columns[column];
  const auto first = std::ranges::find_if(times, [](double t) { return !std::isnan(t); });
  const double begin = first == times.end() ? 0.0 : *first;
  for (double& t : times) t = factor * (t - begin);
  return times;
}

void begin_at_zero(const ConfigTable& table, std::vector<double>& times) {
  const double begin = times.front();
  for (double& t : times) t -= begin;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw table.error(fmt::format("the times in column \"{}\" must increase; they do not at row {}",
                                    table.string("time", "time_s"), i + 1));
  if (times.size() < 2) throw table.error("a history needs two rows or more");
}

}  // namespace pfdm
