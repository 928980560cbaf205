#include "postproc/files/csv_table.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_layout.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace pfdm {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

constexpr std::string_view utf16_marks[] = {"\xFF\xFE", "\xFE\xFF"};

/// Without the blanks at either end and the line end of Windows; a tab there may stand beside an empty entry.
std::string_view with_outer_tabs(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  while (line.starts_with(' ')) line.remove_prefix(1);
  return line;
}

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& path, const CsvOptions& options) : path_(path), options_(options) {}

  CsvTable read() {
    const std::string content = read_file(path_);
    read_lines(content);
    if (options_.is_foreign) layout_ = found_layout();
    if (options_.is_foreign && !layout_.names && !lines_.empty()) take_columns_without_names();
    for (std::size_t i = 0; i < lines_.size(); ++i) take(i);
    add_newer_columns();
    if (options_.has_units && !options_.is_foreign && table_.units.empty())
      throw InputError(fmt::format("{}: expected a row of names and a row of units", path_.string()));
    require_rows();
    return std::move(table_);
  }

 private:
  bool is_own() const { return !options_.own_names.empty(); }

  void require_rows() const {
    const auto is_empty = [](const std::vector<double>& column) {
      return std::ranges::all_of(column, [](double value) { return std::isnan(value); });
    };
    if (is_own() || (table_.n_rows() > 0 && !(options_.is_foreign && std::ranges::all_of(table_.columns, is_empty))))
      return;
    const auto fault = std::ranges::find_if(table_.faults, [](const std::string& text) { return !text.empty(); });
    throw InputError(fault != table_.faults.end() ? *fault
                                                  : fmt::format("{}: it contains no rows of numbers", path_.string()));
  }

  void read_lines(std::string_view rest) {
    for (const std::string_view mark : utf16_marks)
      if (rest.starts_with(mark)) throw InputError(fmt::format("{}: it is UTF-16; save it as UTF-8", path_.string()));
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    if (is_own()) rest = rest.substr(0, rest.rfind('\n') + 1);
    for (int number = 1; !rest.empty(); ++number) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end), text = trimmed(line);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (text.starts_with('#'))
        table_.comments.emplace_back(trimmed(text.substr(1)));
      else if (!text.empty() || is_own())
        lines_.push_back({number, options_.is_foreign ? with_outer_tabs(line) : text});
    }
    layout_.names = 0;
    if (!options_.has_units) return;
    layout_.units = 1;
    layout_.rows = 2;
  }

  CsvLayout found_layout() const {
    try {
      return find_layout(lines_, {.separator = options_.marks.separator,
                                  .decimal = options_.marks.decimal,
                                  .thousands = options_.marks.thousands,
                                  .has_units = options_.has_units,
                                  .is_unit = options_.is_unit});
    } catch (const InputError& cause) {
      throw InputError(fmt::format("{}, {}", path_.string(), cause.what()));
    }
  }

  void take(std::size_t i) {
    line_ = lines_[i];
    if (i < layout_.rows && i != layout_.names && i != layout_.units) {
      table_.comments.emplace_back(line_.text);
      return;
    }
    split_csv(line_.text, layout_.separator, words_);
    if (i == layout_.names) return take_names();
    if (has_idle_end(words_.size() - 1)) words_.pop_back();
    // Spreadsheets leave out what is empty at the end of a row; between blanks nobody knows which entries are missing.
    if (options_.is_foreign && layout_.separator != ' ' && words_.size() < table_.names.size())
      words_.resize(table_.names.size());
    if (words_.size() != table_.names.size())
      throw error(fmt::format("found {} entries in a table of {} columns{}", words_.size(), table_.names.size(),
                              hint_of_decimal_commas()));
    if (i == layout_.units) return take_units();
    for (std::size_t k = 0; k < words_.size(); ++k) table_.columns[k].push_back(number(k));
  }

  void take_columns_without_names() {
    split_csv(lines_[layout_.rows].text, layout_.separator, words_);
    const std::size_t n = words_.size() - (words_.size() > 1 && words_.back().empty() ? 1 : 0);
    for (std::size_t k = 0; k < n; ++k) add_column("");
  }

  void add_column(const std::string& name) {
    table_.add(name, {});
    if (options_.is_foreign) table_.faults.emplace_back();
  }

  /// A separator ends the line, and there are as many columns without it.
  bool has_idle_end(std::size_t n) const {
    return options_.is_foreign && words_.size() > 1 && words_.back().empty() && n == table_.names.size();
  }

  std::string_view hint_of_decimal_commas() const {
    const bool may_be = options_.is_foreign && layout_.separator == ',' && words_.size() == 2 * table_.names.size();
    return may_be ? "; numbers with a decimal comma need another separator between them" : "";
  }

  bool has_own_names() const {
    const std::vector<std::string>& own = options_.own_names;
    return words_.size() <= own.size() && words_.size() + options_.n_newer_names >= own.size() &&
           std::equal(words_.begin(), words_.end(), own.begin());
  }

  void add_newer_columns() {
    if (table_.names.empty()) return;
    for (std::size_t k = table_.names.size(); k < options_.own_names.size(); ++k)
      table_.add(options_.own_names[k], std::vector<double>(table_.n_rows(), 0.0));
  }

  void take_names() {
    if (is_own() && !has_own_names())
      throw error(fmt::format("found \"{}\" instead of \"{}\"", line_.text, fmt::join(options_.own_names, ",")));
    if (options_.is_foreign && words_.size() > 1 && words_.back().empty()) words_.pop_back();
    for (const std::string& word : words_) {
      if (!options_.is_foreign && (word.empty() || parse_double(word)))
        throw error(fmt::format("expected the names of the columns, as in time_s,strain_xx, found \"{}\"", line_.text));
      if (!options_.is_foreign && std::ranges::count(table_.names, word) > 0)
        throw error(fmt::format("two columns are called \"{}\"", word));
      add_column(word);
    }
    if (options_.is_foreign && !layout_.units) take_units_of_names();
  }

  /// "Force [N]": if it is a unit.
  void take_units_of_names() {
    if (options_.is_unit == nullptr) return;
    for (const std::string& name : table_.names) {
      const auto end = bracketed_end(name);
      table_.units.push_back(end && options_.is_unit(*end) ? *end : "");
    }
  }

  void take_units() {
    if (parse_double(words_.front())) throw error("expected a row of units, as in \"s,m/s^2,m/s^2\", found numbers");
    for (const std::string& word : words_) table_.units.push_back(in_brackets(word).value_or(word));
  }

  std::optional<double> value_of(const std::string& word) const {
    return options_.is_foreign ? csv_number(word, layout_.decimal, layout_.thousands) : parse_double(word);
  }

  double number(std::size_t i) {
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    const std::string& word = words_[i];
    if ((word.empty() && options_.has_gaps) || (options_.is_foreign && is_gap(word))) return gap;
    const bool is_whole = std::ranges::count(options_.whole_numbers, table_.names[i]) > 0;
    const auto value = value_of(word);
    if (value && (std::isfinite(*value) || options_.has_gaps || is_own()) && (!is_whole || parse_int(word)))
      return *value;
    if (options_.is_foreign && !table_.faults[i].empty()) return gap;
    const InputError fault = error(fmt::format("\"{}\" in column {} is not a number, as {}{}", word, called(i),
                                               is_whole                 ? "12"
                                               : layout_.decimal == ',' ? "0,5 or -2e6"
                                                                        : "0.5 or -2e6",
                                               hint_of_thousands(word)));
    if (!options_.is_foreign) throw fault;
    table_.faults[i] = fault.what();
    return gap;
  }

  std::string called(std::size_t i) const {
    return table_.names[i].empty() ? fmt::format("{}", i + 1) : fmt::format("\"{}\"", table_.names[i]);
  }

  std::string hint_of_thousands(const std::string& word) const {
    if (!options_.is_foreign || layout_.thousands) return "";
    for (const auto& [mark, shown] : {std::pair{'.', "."}, {',', ","}, {'\'', "'"}, {' ', "blank"}})
      if (mark != layout_.decimal && csv_number(word, layout_.decimal, mark))
        return fmt::format("; if its thousands are apart, set thousands = \"{}\"", shown);
    return "";
  }

  InputError error(const std::string& message) const {
    return InputError(fmt::format("{}, line {}: {}", path_.string(), line_.number, message));
  }

  const std::filesystem::path& path_;
  const CsvOptions& options_;
  CsvTable table_;
  std::vector<CsvLine> lines_;  // neither empty nor comments
  CsvLayout layout_;
  CsvLine line_;                    // that is read
  std::vector<std::string> words_;  // of it
};

template <class Predicate>
std::vector<std::size_t> columns_that(const std::vector<std::string>& names, const Predicate& holds) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (holds(names[i])) found.push_back(i);
  return found;
}

std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 40;
  if (names.size() <= most) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} ... {} in all", fmt::join(std::span(names).first(most), ", "), names.size());
}

}  // namespace

bool CsvTable::has_names() const {
  return std::ranges::any_of(names, [](const std::string& name) { return !name.empty(); });
}

std::size_t CsvTable::find(std::string_view name) const {
  if (!has_names())
    throw InputError(
        fmt::format("there is no column \"{}\": the file has {} columns without names; give the number of "
                    "one, from 1",
                    name, names.size()));
  return find_name(names, name);
}

std::string_view without_unit(std::string_view name) {
  return bracketed_end(name) ? trimmed(name.substr(0, name.find_last_of("[("))) : name;
}

std::size_t find_name(const std::vector<std::string>& names, std::string_view name) {
  const auto name_before_unit = [&](const std::string& of) { return without_unit(of) == name; };
  const auto same_letters = [&](const std::string& of) {
    return lower_case(of) == lower_case(name) || lower_case(without_unit(of)) == lower_case(name);
  };
  for (const std::vector<std::size_t>& found :
       {columns_that(names, [&](const std::string& of) { return of == name; }), columns_that(names, name_before_unit),
        columns_that(names, same_letters)}) {
    if (found.size() == 1) return found.front();
    if (found.size() > 1)
      throw InputError(
          fmt::format("there are {} columns that may be \"{}\" (available: {}); the number of one, from 1, tells them "
                      "apart",
                      found.size(), name, first_of(names)));
  }
  throw InputError(fmt::format("there is no column \"{}\" (available: {})", name, first_of(names)));
}

void CsvTable::require_numbers(std::size_t column) const {
  if (!faults.empty() && !faults[column].empty()) throw InputError(faults[column]);
}

void CsvTable::add(std::string name, std::vector<double> values) {
  names.push_back(std::move(name));
  columns.push_back(std::move(values));
}

CsvTable read_csv(const std::filesystem::path& path, const CsvOptions& options) {
  return CsvReader(path, options).read();
}

void write_csv(const std::filesystem::path& path, const CsvTable& table) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  for (const std::string& comment : table.comments) fmt::format_to(to, "# {}\n", comment);
  fmt::format_to(to, "{}\n", fmt::join(table.names, ","));
  if (!table.units.empty()) fmt::format_to(to, "{}\n", fmt::join(table.units, ","));
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      fmt::format_to(to, "{}{}", table.columns[i][row], i + 1 < table.columns.size() ? ',' : '\n');
  write_file(path, fmt::to_string(out));
}

}  // namespace pfdm
