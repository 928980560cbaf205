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
#include <utility>

namespace pfdm {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

constexpr std::string_view utf16_marks[] = {"\xFF\xFE", "\xFE\xFF"};

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& path, const CsvOptions& options) : path_(path), options_(options) {}

  CsvTable read() {
    const std::string content = read_file(path_);
    read_lines(content);
    if (options_.is_foreign) layout_ = found_layout();
    for (std::size_t i = 0; i < lines_.size(); ++i) take(i);
    if (options_.has_units && table_.units.empty())
      throw InputError(fmt::format("{}: expected a row of names and a row of units", path_.string()));
    if (table_.n_rows() == 0 && !is_own())
      throw InputError(fmt::format("{}: it contains no rows of numbers", path_.string()));
    return std::move(table_);
  }

 private:
  bool is_own() const { return !options_.own_names.empty(); }

  void read_lines(std::string_view rest) {
    for (const std::string_view mark : utf16_marks)
      if (rest.starts_with(mark)) throw InputError(fmt::format("{}: it is UTF-16; save it as UTF-8", path_.string()));
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    if (is_own()) rest = rest.substr(0, rest.rfind('\n') + 1);
    for (int number = 1; !rest.empty(); ++number) {
      const std::string_view line = take_line(rest);
      if (line.starts_with('#'))
        table_.comments.emplace_back(trimmed(line.substr(1)));
      else if (!line.empty() || is_own())
        lines_.push_back({number, line});
    }
    if (options_.has_units) layout_.units = 1;
  }

  CsvLayout found_layout() const {
    try {
      return find_layout(lines_, {.separator = options_.separator,
                                  .decimal = options_.decimal,
                                  .has_units = options_.has_units,
                                  .has_gaps = options_.has_gaps,
                                  .is_unit = options_.is_unit});
    } catch (const InputError& cause) {
      throw InputError(fmt::format("{}, {}", path_.string(), cause.what()));
    }
  }

  void take(std::size_t i) {
    line_ = lines_[i];
    if (i < layout_.names) {
      table_.comments.emplace_back(line_.text);
      return;
    }
    split_csv(line_.text, layout_.separator, words_);
    if (i == layout_.names) return take_names();
    if (has_idle_end(words_.size() - 1)) words_.pop_back();
    if (words_.size() != table_.names.size())
      throw error(fmt::format("found {} entries in a table of {} columns{}", words_.size(), table_.names.size(),
                              hint_of_decimal_commas()));
    if (i == layout_.units) return take_units();
    for (std::size_t k = 0; k < words_.size(); ++k) table_.columns[k].push_back(number(k));
  }

  /// A separator ends the line, and there are as many columns without it.
  bool has_idle_end(std::size_t n) const {
    return options_.is_foreign && words_.size() > 1 && words_.back().empty() && n == table_.names.size();
  }

  std::string_view hint_of_decimal_commas() const {
    const bool may_be = options_.is_foreign && layout_.separator == ',' && words_.size() == 2 * table_.names.size();
    return may_be ? "; numbers with a decimal comma need another separator between them" : "";
  }

  void take_names() {
    if (is_own() && !std::ranges::equal(words_, options_.own_names))
      throw error(fmt::format("found \"{}\" instead of \"{}\"", line_.text, fmt::join(options_.own_names, ",")));
    if (options_.is_foreign && words_.size() > 1 && words_.back().empty()) words_.pop_back();
    for (const std::string& word : words_) {
      if (word.empty() || parse_double(word))
        throw error(fmt::format("expected the names of the columns, as in time_s,strain_xx, found \"{}\"", line_.text));
      if (std::ranges::count(table_.names, word) > 0) throw error(fmt::format("two columns are called \"{}\"", word));
      table_.add(word, {});
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
    return options_.is_foreign ? csv_number(word, layout_.decimal) : parse_double(word);
  }

  double number(std::size_t i) const {
    const std::string& word = words_[i];
    if (word.empty() && options_.has_gaps) return std::numeric_limits<double>::quiet_NaN();
    const bool is_whole = std::ranges::count(options_.whole_numbers, table_.names[i]) > 0;
    const auto value = value_of(word);
    if (!value || !(std::isfinite(*value) || options_.has_gaps || is_own()) || (is_whole && !parse_int(word)))
      throw error(fmt::format("\"{}\" in column \"{}\" is not a number, as {}", word, table_.names[i],
                              is_whole                 ? "12"
                              : layout_.decimal == ',' ? "0,5 or -2e6"
                                                       : "0.5 or -2e6"));
    return *value;
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

}  // namespace

std::size_t CsvTable::find(std::string_view name) const {
  const auto exact = std::ranges::find(names, name);
  if (exact != names.end()) return static_cast<std::size_t>(exact - names.begin());
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (bracketed_end(names[i]) && trimmed(std::string_view(names[i]).substr(0, names[i].find_last_of("[("))) == name)
      found.push_back(i);
  if (found.size() == 1) return found.front();
  throw InputError(fmt::format("there {} \"{}\" (available: {})",
                               found.empty() ? "is no column" : "are two columns that may be", name,
                               fmt::join(names, ", ")));
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
