#include "postproc/files/csv_table.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

void read_header(CsvTable& table, std::string_view line, const std::string& where) {
  for (const std::string_view word : split_at_commas(line)) {
    if (word.empty() || parse_double(word))
      throw InputError(
          fmt::format("{}: expected the names of the columns, as in time_s,strain_xx, found \"{}\"", where, line));
    if (std::ranges::count(table.names, word) > 0)
      throw InputError(fmt::format("{}: two columns are called \"{}\"", where, word));
    table.add(std::string(word), {});
  }
}

void read_row(CsvTable& table, std::string_view line, const std::string& where) {
  const auto words = split_at_commas(line);
  if (words.size() != table.names.size())
    throw InputError(
        fmt::format("{}: found {} entries in a table of {} columns", where, words.size(), table.names.size()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = parse_double(words[i]);
    if (!value || !std::isfinite(*value))
      throw InputError(fmt::format("{}: \"{}\" in column \"{}\" is not a number", where, words[i], table.names[i]));
    table.columns[i].push_back(*value);
  }
}

}  // namespace

const std::vector<double>& CsvTable::column(std::string_view name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return columns[i];
  throw InputError(fmt::format("there is no column \"{}\" (available: {})", name, fmt::join(names, ", ")));
}

void CsvTable::add(std::string name, std::vector<double> values) {
  names.push_back(std::move(name));
  columns.push_back(std::move(values));
}

CsvTable read_csv(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::string_view rest = content;
  CsvTable table;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = take_line(rest);
    const std::string where = fmt::format("{}, line {}", path.string(), line_number);
    if (line.empty()) continue;
    if (line.front() == '#')
      table.comments.emplace_back(trimmed(line.substr(1)));
    else if (table.names.empty())
      read_header(table, line, where);
    else
      read_row(table, line, where);
  }
  if (table.n_rows() == 0) throw InputError(fmt::format("{}: it contains no rows of numbers", path.string()));
  return table;
}

void write_csv(const std::filesystem::path& path, const CsvTable& table) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  for (const std::string& comment : table.comments) fmt::format_to(to, "# {}\n", comment);
  fmt::format_to(to, "{}\n", fmt::join(table.names, ","));
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      fmt::format_to(to, "{}{}", table.columns[i][row], i + 1 < table.columns.size() ? ',' : '\n');
  write_file(path, fmt::to_string(out));
}

}  // namespace pfdm
