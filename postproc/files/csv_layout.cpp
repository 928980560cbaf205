#include "postproc/files/csv_layout.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace pfdm {
namespace {

constexpr std::string_view separators = "\t;, ";
constexpr std::string_view decimals = ".,";

/// Numbers among the entries of a line of n columns; 0 of what is no row. Where others than gaps may stand beside them
/// (`mixed`), entries at the end may be missing too.
std::size_t numbers_in_row(const std::vector<std::string>& words, std::size_t n, const CsvLayout& marks, bool mixed) {
  const bool fits = words.size() == n || (words.size() == n + 1 && words.back().empty()) ||
                    (mixed && words.size() < n && marks.separator != ' ');
  if (!fits) return 0;
  std::size_t n_numbers = 0;
  for (std::size_t i = 0; i < std::min(n, words.size()); ++i) {
    if (is_gap(words[i])) continue;
    if (csv_number(words[i], marks.decimal, marks.thousands))
      ++n_numbers;
    else if (!mixed)
      return 0;
  }
  return n_numbers;
}

/// 1,234 or 12,345,678: a number with a comma between its thousands, or a fraction.
bool may_have_thousands(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || comma == 0 || comma > 3 || word[0] == '0') return false;
  return word.size() == comma + 4 && std::ranges::all_of(word, [](char c) { return c == ',' || std::isdigit(c) != 0; });
}

constexpr std::size_t most_mixed_lines = 20000;  // that are looked at for a layout

class LayoutFinder {
 public:
  LayoutFinder(const std::vector<CsvLine>& lines, const CsvHints& hints) : lines_(lines), hints_(hints) {}

  /// No number holds a blank, tab or semicolon, and commas only as decimal marks: of two separators that read as many
  /// rows none stands in a row.
  CsvLayout find() {
    Trial best = best_of(&LayoutFinder::whole_rows);
    if (best.last_line < lines_.size()) {
      const Trial mixed = best_of(&LayoutFinder::mixed_rows);
      if (mixed.n_numbers > 2 * best.n_numbers) best = mixed;
    }
    if (best.n_numbers == 0) best = best_of(&LayoutFinder::rows_without_names);
    if (best.n_numbers == 0) return fallback();
    require_one_meaning(best.layout);
    return best.layout;
  }

 private:
  struct Trial {
    CsvLayout layout{};
    std::size_t n_numbers = 0;
    std::size_t last_line = 0;  ///< the one after its last row
  };
  using Way = Trial (LayoutFinder::*)(const CsvLayout& marks);

  /// With the marks that read the most numbers.
  Trial best_of(Way way) {
    Trial best;
    for (const char separator : separators) {
      if (hints_.separator && *hints_.separator != separator) continue;
      for (const char decimal : decimals) {
        if (decimal == separator || (hints_.decimal && *hints_.decimal != decimal)) continue;
        if (hints_.thousands == decimal) continue;
        const CsvLayout marks{.separator = separator, .decimal = decimal, .thousands = hints_.thousands};
        const Trial trial = (this->*way)(marks);
        if (trial.n_numbers > best.n_numbers) best = trial;
      }
    }
    return best;
  }

  void split(std::size_t line, char separator) { split_csv(lines_[line].text, separator, words_); }

  /// The first line of numbers alone below a line of as many names, and all such rows from it on.
  Trial whole_rows(const CsvLayout& marks) {
    Trial trial;
    std::size_t n = 0;  // entries of the line before, if they may be names
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      split(i, marks.separator);
      const std::size_t n_numbers = n > 0 ? numbers_in_row(words_, n, marks, false) : 0;
      if (n_numbers > 0) {
        if (trial.n_numbers == 0) trial.layout = layout_above(i, marks);
        trial.n_numbers += n_numbers;
        trial.last_line = i + 1;
      } else if (trial.n_numbers == 0) {
        n = n_columns(i, n, marks.separator);
      }
    }
    return trial;
  }

  /// Successive lines below a line of names, with numbers in some columns.
  Trial mixed_rows(const CsvLayout& marks) {
    Trial best, trial;
    std::size_t n = 0;
    for (std::size_t i = 0; i < std::min(lines_.size(), most_mixed_lines); ++i) {
      split(i, marks.separator);
      const std::size_t n_numbers = n > 0 ? numbers_in_row(words_, n, marks, true) : 0;
      if (n_numbers > 0 && (trial.n_numbers > 0 || !is_line_of_units(i, marks.separator))) {
        if (trial.n_numbers == 0) trial.layout = layout_above(i, marks);
        trial.n_numbers += n_numbers;
        if (trial.n_numbers > best.n_numbers) best = trial;
        continue;
      }
      trial = {};
      n = n_columns(i, n, marks.separator);
      if (std::ranges::any_of(words_, is_any_number) && !is_line_of_units(i, marks.separator)) n = 0;
    }
    return best;
  }

  /// All lines from one on have as many entries, numbers among them.
  Trial rows_without_names(const CsvLayout& marks) {
    Trial trial;
    std::size_t n = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      split(i, marks.separator);
      const std::size_t all = words_.size() - (words_.size() > 1 && words_.back().empty() ? 1 : 0);
      const std::size_t n_numbers = numbers_in_row(words_, all, marks, true);
      if (n_numbers > 0 && trial.n_numbers == 0) {
        if (i > 0 && marks.separator != ' ' && n_entries(i - 1, marks.separator) > 1) return {};  // names they are
        n = all;
        trial.layout = marks;
        trial.layout.rows = i;
      }
      if (n_numbers > 0 && all == n)
        trial.n_numbers += n_numbers;
      else
        trial = {};
    }
    return trial;
  }

  std::size_t n_entries(std::size_t line, char separator) {
    split(line, separator);
    return words_.size();
  }

  static bool is_any_number(const std::string& word) { return csv_number(word, '.') || csv_number(word, ','); }

  /// Of the table whose names may stand in a line, or its units, of which the last ones may be missing.
  std::size_t n_columns(std::size_t line, std::size_t n_above, char separator) {
    split(line, separator);
    if (n_above > 0 && words_.size() == n_above && is_line_of_units(line, separator)) return n_above;
    const std::size_t n = n_names(lines_[line].text, separator);
    // Numbers may be names, but below a line of as many names it is a row with text in it. 1 may be a unit.
    const auto is_entry = [](const std::string& word) { return is_any_number(word) && word != "1"; };
    return n == n_above && std::ranges::any_of(words_, is_entry) ? 0 : n;
  }

  /// Of the words of a line; 0 if they are no names.
  std::size_t n_names(std::string_view line, char separator) const {
    const std::ptrdiff_t n = std::ssize(words_) - (words_.size() > 1 && words_.back().empty() ? 1 : 0);
    if (separator == ' ' && line.find('\t') != std::string_view::npos) return 0;
    if (n == 1 && line.find_first_of(separators.substr(0, 3)) != std::string_view::npos) return 0;
    const auto is_no_name = [](const std::string& word) { return word.empty() || is_any_number(word); };
    return is_any_number(words_.front()) || std::ranges::all_of(words_.begin(), words_.begin() + n, is_no_name)
               ? 0
               : static_cast<std::size_t>(n);
  }

  CsvLayout layout_above(std::size_t row, const CsvLayout& marks) {
    CsvLayout layout = marks;
    layout.names = row - 1;
    layout.rows = row;
    const bool has_units =
        row > 1 && may_be_names_of(row - 2, row - 1, marks.separator) &&
        (is_line_of_units(row - 1, marks.separator) || (hints_.has_units && may_have_units(row - 1, marks.separator)));
    if (has_units) {
      layout.names = row - 2;
      layout.units = row - 1;
    }
    return layout;
  }

  bool is_given_as_unit(const std::string& word) const {
    return word == "-" || in_brackets(word) || (hints_.is_unit != nullptr && hints_.is_unit(word));
  }

  bool is_line_of_units(std::size_t line, char separator) {
    split(line, separator);
    return std::ranges::all_of(words_,
                               [this](const std::string& word) { return word.empty() || is_given_as_unit(word); });
  }

  /// Of the line below the names of a table that mostly has units: one of its words is a known one.
  bool may_have_units(std::size_t line, char separator) {
    split(line, separator);
    return hints_.is_unit == nullptr ||
           std::ranges::any_of(words_, [this](const std::string& word) { return is_given_as_unit(word); });
  }

  bool may_be_names_of(std::size_t line, std::size_t units, char separator) {
    split(units, separator);
    const std::size_t n = words_.size();
    split(line, separator);
    return words_.size() == n && n_names(lines_[line].text, separator) > 0 &&
           std::ranges::none_of(words_, is_any_number);
  }

  void require_one_meaning(const CsvLayout& layout) {
    if (layout.decimal != ',' || hints_.decimal || hints_.thousands) return;
    std::optional<std::pair<int, std::string>> doubtful;
    for (std::size_t i = layout.rows; i < lines_.size(); ++i) {
      split(i, layout.separator);
      for (const std::string& word : words_) {
        if (word.find(',') == std::string::npos) continue;
        const bool may_have = may_have_thousands(word);
        if (!may_have && csv_number(word, ',')) return;
        if (may_have && !doubtful) doubtful = {lines_[i].number, word};
      }
    }
    if (doubtful)
      throw InputError(
          fmt::format("line {}: {} may be a fraction or have its thousands apart, as all numbers with a comma "
                      "here; name the \"decimal\" mark, \",\" or \".\", or the mark of the \"thousands\"",
                      doubtful->first, doubtful->second));
  }

  /// With which the reader says what is wrong with the file.
  CsvLayout fallback() const {
    CsvLayout layout{.separator = hints_.separator.value_or(','),
                     .decimal = hints_.decimal.value_or('.'),
                     .thousands = hints_.thousands,
                     .names = 0};
    if (hints_.has_units && lines_.size() > 1) {
      layout.units = 1;
      layout.rows = 2;
    }
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

CsvLayout find_layout(const std::vector<CsvLine>& lines, const CsvHints& hints) {
  return LayoutFinder(lines, hints).find();
}

}  // namespace pfdm
