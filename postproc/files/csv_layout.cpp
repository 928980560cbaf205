#include "postproc/files/csv_layout.h"

#include "physics/error.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace pfdm {
namespace {

constexpr std::string_view separators = "\t;, ";
constexpr std::string_view decimals = ".,";

/// Where the next entry ends: at the separator that no quotes hold.
std::size_t end_of_entry(std::string_view line, char separator) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (!quoted && (line[i] == separator || (separator == ' ' && line[i] == '\t'))) return i;
  }
  return std::string_view::npos;
}

std::string unquoted(std::string_view word) {
  if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = trimmed(word.substr(1, word.size() - 2));
  return std::string(word);
}

/// Of a whole line: as many numbers as there are names, or gaps where there may be any.
bool is_row(const std::vector<std::string>& words, std::size_t n, char decimal, bool has_gaps) {
  if (words.size() != n && !(words.size() == n + 1 && words.back().empty())) return false;
  std::size_t n_numbers = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (words[i].empty() && has_gaps) continue;
    if (!csv_number(words[i], decimal)) return false;
    ++n_numbers;
  }
  return n_numbers > 0;
}

/// 1,234 or 12,345,678: a number with a comma between its thousands, or a fraction.
bool may_have_thousands(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || comma == 0 || comma > 3 || word[0] == '0') return false;
  return word.size() == comma + 4 && std::ranges::all_of(word, [](char c) { return c == ',' || std::isdigit(c) != 0; });
}

class LayoutFinder {
 public:
  LayoutFinder(const std::vector<CsvLine>& lines, const CsvHints& hints) : lines_(lines), hints_(hints) {}

  /// No number holds a blank, tab or semicolon, and commas only as decimal marks: of two separators that read as many
  /// rows none stands in a row.
  CsvLayout find() {
    Trial best;
    for (const char separator : separators) {
      if (hints_.separator && *hints_.separator != separator) continue;
      const Trial trial = best_decimal(separator);
      if (trial.n_rows > best.n_rows) best = trial;
    }
    if (best.n_rows == 0) return fallback();
    require_one_meaning(best.layout);
    return best.layout;
  }

 private:
  struct Trial {
    CsvLayout layout{};
    std::size_t n_rows = 0;
  };

  void split(std::size_t line, char separator) { split_csv(lines_[line].text, separator, words_); }

  Trial best_decimal(char separator) {
    Trial best;
    for (const char decimal : decimals) {
      if (decimal == separator || (hints_.decimal && *hints_.decimal != decimal)) continue;
      const Trial trial = rows_with(separator, decimal);
      if (trial.n_rows > best.n_rows) best = trial;
    }
    return best;
  }

  /// The first line of numbers below a line of as many names, and how many rows there are from it on.
  Trial rows_with(char separator, char decimal) {
    Trial trial;
    std::size_t n = 0;  // entries of the line before, if they may be names
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      split(i, separator);
      if (trial.n_rows > 0) {
        if (is_row(words_, n, decimal, hints_.has_gaps)) ++trial.n_rows;
      } else if (n > 0 && is_row(words_, n, decimal, hints_.has_gaps)) {
        trial = {.layout = layout_above(i, separator, decimal), .n_rows = 1};
      } else {
        n = n_names(lines_[i].text, separator);
      }
    }
    return trial;
  }

  /// Of the words of a line; 0 if they are no names.
  std::size_t n_names(std::string_view line, char separator) const {
    const std::ptrdiff_t n = std::ssize(words_) - (words_.size() > 1 && words_.back().empty() ? 1 : 0);
    if (separator == ' ' && line.find('\t') != std::string_view::npos) return 0;
    if (n == 1 && line.find_first_of(separators.substr(0, 3)) != std::string_view::npos) return 0;
    const auto is_number = [](const std::string& word) { return csv_number(word, '.') || csv_number(word, ','); };
    return is_number(words_.front()) || std::ranges::all_of(words_.begin(), words_.begin() + n, is_number)
               ? 0
               : static_cast<std::size_t>(n);
  }

  CsvLayout layout_above(std::size_t row, char separator, char decimal) {
    CsvLayout layout{.separator = separator, .decimal = decimal, .names = row - 1};
    if (hints_.has_units) {
      layout.names = row > 1 ? row - 2 : 0;
      layout.units = layout.names + 1;
    } else if (row > 1 && is_line_of_units(row - 1, separator) && may_be_names_of(row - 2, row - 1, separator)) {
      layout.names = row - 2;
      layout.units = row - 1;
    }
    return layout;
  }

  bool is_line_of_units(std::size_t line, char separator) {
    split(line, separator);
    return std::ranges::all_of(words_, [this](const std::string& word) {
      return word.empty() || word == "-" || in_brackets(word) || (hints_.is_unit != nullptr && hints_.is_unit(word));
    });
  }

  bool may_be_names_of(std::size_t line, std::size_t units, char separator) {
    split(units, separator);
    const std::size_t n = words_.size();
    split(line, separator);
    return words_.size() == n && std::ranges::none_of(words_, [&](const std::string& word) {
             return (word.empty() && &word != &words_.back()) || csv_number(word, '.') || csv_number(word, ',');
           });
  }

  void require_one_meaning(const CsvLayout& layout) {
    if (layout.decimal != ',' || hints_.decimal) return;
    std::optional<std::pair<int, std::string>> doubtful;
    for (std::size_t i = layout.rows(); i < lines_.size(); ++i) {
      split(i, layout.separator);
      for (const std::string& word : words_) {
        if (word.find(',') == std::string::npos) continue;
        if (!may_have_thousands(word)) return;
        if (!doubtful) doubtful = {lines_[i].number, word};
      }
    }
    if (doubtful)
      throw InputError(
          fmt::format("line {}: {} may be a fraction or have its thousands apart, as all numbers with a comma "
                      "here; name the \"decimal\" mark, \",\" or \".\"",
                      doubtful->first, doubtful->second));
  }

  /// With which the reader says what is wrong with the file.
  CsvLayout fallback() const {
    CsvLayout layout{.separator = hints_.separator.value_or(','), .decimal = hints_.decimal.value_or('.')};
    if (hints_.has_units) layout.units = 1;
    if (hints_.separator || lines_.empty()) return layout;
    for (const char separator : separators.substr(0, 3))
      if (separator != hints_.decimal && lines_[0].text.find(separator) != std::string_view::npos) {
        layout.separator = separator;
        break;
      }
    return layout;
  }

  const std::vector<CsvLine>& lines_;
  const CsvHints& hints_;
  std::vector<std::string> words_;  // of the line that is looked at
};

}  // namespace

void split_csv(std::string_view line, char separator, std::vector<std::string>& words) {
  words.clear();
  for (;;) {
    const std::size_t end = end_of_entry(line, separator);
    words.push_back(unquoted(trimmed(line.substr(0, end))));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (separator == ' ') line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  }
}

std::optional<double> csv_number(std::string_view word, char decimal) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos)
    return decimal == ',' && word.find('.') != std::string_view::npos ? std::nullopt : parse_double(word);
  if (decimal != ',' || comma + 1 == word.size() || word.find('.') != std::string_view::npos) return std::nullopt;
  std::string with_point(word);
  with_point[comma] = '.';
  return parse_double(with_point);
}

std::optional<std::string> in_brackets(std::string_view text) {
  const bool around =
      text.size() >= 2 && ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'));
  return around ? std::optional(std::string(trimmed(text.substr(1, text.size() - 2)))) : std::nullopt;
}

std::optional<std::string> bracketed_end(std::string_view name) {
  const std::size_t start = name.find_last_of("[(");
  if (start == std::string_view::npos || trimmed(name.substr(0, start)).empty()) return std::nullopt;
  return in_brackets(name.substr(start));
}

CsvLayout find_layout(const std::vector<CsvLine>& lines, const CsvHints& hints) {
  return LayoutFinder(lines, hints).find();
}

}  // namespace pfdm
