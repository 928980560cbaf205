#include "postproc/files/csv_table.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
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

/// What stands between the commas of a line, trimmed; one entry more than there are commas.
void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    words.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& path, const CsvOptions& options) : path_(path), options_(options) {}

  CsvTable read() {
    const std::string content = read_file(path_);
    std::string_view rest = content;
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    if (is_own()) rest = rest.substr(0, rest.rfind('\n') + 1);
    while (!rest.empty()) {
      line_ = take_line(rest);
      ++line_number_;
      take();
    }
    if (options_.has_units && table_.units.empty())
      throw InputError(fmt::format("{}: expected a row of names and a row of units", path_.string()));
    if (table_.n_rows() == 0 && !is_own())
      throw InputError(fmt::format("{}: it contains no rows of numbers", path_.string()));
    return std::move(table_);
  }

 private:
  bool is_own() const { return !options_.own_names.empty(); }

  void take() {
    if (line_.empty() && !is_own()) return;
    if (line_.starts_with('#')) {
      table_.comments.emplace_back(trimmed(line_.substr(1)));
      return;
    }
    split(line_, words_);
    if (table_.names.empty()) return take_names();
    if (words_.size() != table_.names.size())
      throw error(fmt::format("found {} entries in a table of {} columns", words_.size(), table_.names.size()));
    if (options_.has_units && table_.units.empty()) return take_units();
    for (std::size_t i = 0; i < words_.size(); ++i) table_.columns[i].push_back(number(i));
  }

  void take_names() {
    if (is_own() && !std::ranges::equal(words_, options_.own_names))
      throw error(fmt::format("found \"{}\" instead of \"{}\"", line_, fmt::join(options_.own_names, ",")));
    for (const std::string_view word : words_) {
      if (word.empty() || parse_double(word))
        throw error(fmt::format("expected the names of the columns, as in time_s,strain_xx, found \"{}\"", line_));
      if (std::ranges::count(table_.names, word) > 0) throw error(fmt::format("two columns are called \"{}\"", word));
      table_.add(std::string(word), {});
    }
  }

  void take_units() {
    if (parse_double(words_.front())) throw error("expected a row of units, as in \"s,m/s^2,m/s^2\", found numbers");
    table_.units.assign(words_.begin(), words_.end());
  }

  double number(std::size_t i) const {
    const std::string_view word = words_[i];
    if (word.empty() && options_.has_gaps) return std::numeric_limits<double>::quiet_NaN();
    const bool is_whole = std::ranges::count(options_.whole_numbers, table_.names[i]) > 0;
    const auto value = parse_double(word);
    if (!value || !(std::isfinite(*value) || options_.has_gaps || is_own()) || (is_whole && !parse_int(word)))
      throw error(fmt::format("\"{}\" in column \"{}\" is not a number, as {}", word, table_.names[i],
                              is_whole ? "12" : "0.5 or -2e6"));
    return *value;
  }

  InputError error(const std::string& message) const {
    return InputError(fmt::format("{}, line {}: {}", path_.string(), line_number_, message));
  }

  const std::filesystem::path& path_;
  const CsvOptions& options_;
  CsvTable table_;
  std::string_view line_;
  std::vector<std::string_view> words_;  // of the line
  int line_number_ = 0;
};

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
