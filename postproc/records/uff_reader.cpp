#include "postproc/records/uff_reader.h"

#include "physics/error.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>

namespace pfdm {
namespace {

constexpr int acceleration_data = 12;  // specific data type
constexpr int lines_before_data = 11;  // of dataset 58

/// The columns [from, from + width) of a line with fixed columns, without blanks.
std::string_view field(std::string_view line, std::size_t from, std::size_t width) {
  return from < line.size() ? trimmed(line.substr(from, width)) : std::string_view();
}

std::string unless_none(std::string_view text) { return text == "NONE" ? "" : std::string(text); }

/// Units as this program writes them: a square may be a sign of UTF-8 or of Latin 1.
std::string unit_of(std::string_view label) {
  std::string unit = unless_none(label);
  for (const std::string_view square : {"\xc2\xb2", "\xb2", "**2"})
    if (const std::size_t at = unit.find(square); at != std::string::npos)
      unit = fmt::format("{}^2{}", unit.substr(0, at), unit.substr(at + square.size()));
  return unit == "m/s2" ? "m/s^2" : unit;
}

/// "+X" ... "-Z" for 1 to 3 and their negatives; 4 to 6 are rotations.
std::string direction_name(int direction) {
  constexpr std::array<std::string_view, 7> names{"", "X", "Y", "Z", "RX", "RY", "RZ"};
  const auto k = static_cast<std::size_t>(std::abs(direction));
  if (direction == 0 || k >= names.size()) return "";
  return fmt::format("{}{}", direction < 0 ? '-' : '+', names[k]);
}

class UffReader {
 public:
  explicit UffReader(const std::filesystem::path& path) : path_(path), content_(read_file(path)) {}

  std::vector<UffFunction> read() {
    std::vector<UffFunction> functions;
    while (find_delimiter()) {
      const std::string_view header = next_line("a dataset's number");
      const std::string_view number = field(header, 0, 6);
      if (number == "58")
        functions.push_back(read_function(header));
      else
        seen_.insert(std::string(number));
      skip_to_delimiter();
    }
    if (functions.empty())
      throw InputError(
          seen_.empty()
              ? fmt::format("{}: this is not a universal file: no dataset begins", path_.string())
              : fmt::format("{}: there is no dataset 58 (available: {})", path_.string(), fmt::join(seen_, ", ")));
    return functions;
  }

 private:
  InputError error(const std::string& message) const {
    const auto line = 1 + std::count(content_.begin(), content_.begin() + start_, '\n');
    return InputError(fmt::format("{}, dataset of line {}: {}", path_.string(), line, message));
  }

  std::string_view next_line(const char* what) {
    if (at_ >= content_.size()) throw error(fmt::format("the file ends where {} is expected", what));
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    std::string_view line(content_.data() + at_, end - at_);
    at_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  bool find_delimiter() {
    while (at_ < content_.size()) {
      start_ = at_;
      if (trimmed(next_line("-1")) == "-1") return true;
    }
    return false;
  }

  void skip_to_delimiter() {
    while (at_ < content_.size())
      if (trimmed(next_line("-1")) == "-1") return;
    throw error("it is truncated: its closing -1 is missing");
  }

  int integer(std::string_view line, std::size_t from, std::size_t width, const char* what) const {
    const std::string_view text = field(line, from, width);
    const auto value = parse_int(text);
    if (!value) throw error(fmt::format("\"{}\" is not a valid {}", text, what));
    return *value;
  }

  double real(std::string_view line, std::size_t from, const char* what) const {
    std::string text(field(line, from, 13));
    std::ranges::replace(text, 'D', 'E');
    if (text.starts_with('+')) text.erase(0, 1);
    const auto value = parse_double(text);
    if (!value) throw error(fmt::format("\"{}\" is not a valid {}", text, what));
    return *value;
  }

  UffFunction read_function(std::string_view header) {
    UffFunction f;
    f.id = unless_none(trimmed(next_line("an ID line")));
    for (int i = 1; i < 5; ++i) next_line("an ID line");
    const std::string_view dof = next_line("record 6");
    f.type = integer(dof, 0, 5, "function type");
    f.place = fmt::format("{}{}", field(dof, 41, 10), direction_name(parse_int(field(dof, 51, 4)).value_or(0)));
    read_form(next_line("record 7"), f);
    f.abscissa_unit = unit_of(field(next_line("record 8"), 47, 20));
    const std::string_view ordinate = next_line("record 9");
    f.label = unless_none(field(ordinate, 26, 20));
    f.unit = unit_of(field(ordinate, 47, 20));
    f.was_in_g = parse_int(field(ordinate, 0, 10)) == acceleration_data && (f.unit == "g" || f.unit == "G");
    if (f.was_in_g) f.unit = "g0";
    next_line("record 10");
    next_line("record 11");
    if (f.type != uff_time_response) return f;
    if (f.values.is_complex) throw error("its values are complex; a record over time is real");
    const std::vector<double> numbers = field(header, 6, 1) == "b" ? binary_numbers(f, header) : text_numbers(f);
    for (std::size_t i = 0; i < f.n; ++i) {
      f.abscissa.push_back(f.even ? f.first + static_cast<double>(i) * f.step : numbers[2 * i]);
      f.ordinate.push_back(f.even ? numbers[i] : numbers[2 * i + 1]);
      if (!std::isfinite(f.abscissa.back()))
        throw error(fmt::format("value {} of its abscissa is {}; it must be finite", i + 1, f.abscissa.back()));
    }
    return f;
  }

  void read_form(std::string_view line, UffFunction& f) const {
    const int type = integer(line, 0, 10, "data type");
    if (type != 2 && type != 4 && type != 5 && type != 6)
      throw error(fmt::format("data type {} is not supported; 2, 4, 5 and 6 are", type));
    f.values = {.is_double = type == 4 || type == 6, .is_complex = type >= 5};
    const int n = integer(line, 10, 10, "number of values");
    if (n < 1) throw error(fmt::format("it has {} values; at least 1 is required", n));
    f.n = static_cast<std::size_t>(n);
    f.even = integer(line, 20, 10, "abscissa spacing") == 1;
    f.first = real(line, 30, "first abscissa");
    f.step = real(line, 43, "abscissa increment");
    if (f.even && !(f.step > 0.0))
      throw error(fmt::format("its abscissa increment is {}; it must be positive", f.step));
  }

  std::vector<double> text_numbers(UffFunction& f) {
    const std::size_t due = f.even ? f.n : 2 * f.n;
    std::vector<double> numbers;
    while (numbers.size() < due) {
      const std::string_view line = next_line("a data value");
      if (trimmed(line) == "-1") throw error(fmt::format("it has {} of {} data values", numbers.size(), due));
      append_numbers(line, numbers);
    }
    const auto end = numbers.begin() + due;
    if (std::any_of(end, numbers.end(), [](double filling) { return filling != 0.0; }))
      throw error(fmt::format("it has more than its {} data values", due));
    f.n_filling = numbers.size() - due;
    numbers.erase(end, numbers.end());
    return numbers;
  }

  /// Columns may touch where a sign fills them.
  void append_numbers(std::string_view line, std::vector<double>& numbers) const {
    std::string text(line);
    std::ranges::replace(text, 'D', 'E');
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
      while (at != end && (*at == ' ' || *at == '+' || *at == '\t')) ++at;
      if (at == end) return;
      double value = 0.0;
      const auto [next, fault] = std::from_chars(at, end, value);
      const bool is_beyond = fault == std::errc::result_out_of_range;
      if (is_beyond) value = std::strtod(at, nullptr);  // 0 where it is too small
      if (fault == std::errc::invalid_argument || (is_beyond && std::isinf(value))) {
        const std::string_view rest(at, static_cast<std::size_t>(end - at));
        throw error(fmt::format("\"{}\" is {}", rest.substr(0, rest.find_first_of(" \t")),
                                is_beyond ? "beyond the numbers of double precision" : "not a number"));
      }
      numbers.push_back(value);
      at = next;
    }
  }

  std::vector<double> binary_numbers(const UffFunction& f, std::string_view header) {
    const int order = integer(header, 7, 6, "byte order"), format = integer(header, 13, 6, "floating-point format");
    if (order != 1 && order != 2) throw error(fmt::format("byte order {} is not supported; 1 and 2 are", order));
    if (format != 2) throw error(fmt::format("its numbers have format {}; only IEEE 754 (2) is read", format));
    if (const int n = integer(header, 19, 12, "number of lines"); n != lines_before_data)
      throw error(fmt::format("found {} lines before its data; expected {}", n, lines_before_data));
    const std::size_t size = f.values.is_double ? 8 : 4, abscissa = f.even ? 0 : size_of_abscissa(f, size);
    if (!ends_after(f.n * (abscissa + size)))
      throw error(fmt::format("its closing -1 does not follow {} binary values of {} bytes", f.n, size));
    const bool swapped = (order == 1) != (std::endian::native == std::endian::little);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < f.n; ++i) {
      if (!f.even) numbers.push_back(take(abscissa, swapped));
      numbers.push_back(take(size, swapped));
    }
    return numbers;
  }

  /// In single or double precision, writers differ; the number of bytes in the header is not to be relied on.
  std::size_t size_of_abscissa(const UffFunction& f, std::size_t size) const {
    return ends_after(f.n * (4 + size)) ? 4 : 8;
  }

  /// Whether the dataset's closing line comes so many bytes from here.
  bool ends_after(std::size_t bytes) const {
    if (at_ + bytes > content_.size()) return false;
    std::string_view rest = std::string_view(content_).substr(at_ + bytes, 8);
    rest.remove_prefix(std::min(rest.find_first_not_of("\r\n"), rest.size()));
    return rest.starts_with("    -1");
  }

  double take(std::size_t size, bool swapped) { return size == 4 ? take<float>(swapped) : take<double>(swapped); }

  template <class Number>
  double take(bool swapped) {
    std::array<char, sizeof(Number)> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[swapped ? bytes.size() - 1 - i : i] = content_[at_ + i];
    at_ += bytes.size();
    return std::bit_cast<Number>(bytes);
  }

  const std::filesystem::path& path_;
  std::string content_;
  std::size_t at_ = 0;     // of the next byte
  std::size_t start_ = 0;  // of the dataset
  std::set<std::string> seen_;
};

}  // namespace

std::vector<UffFunction> read_uff(const std::filesystem::path& path) { return UffReader(path).read(); }

}  // namespace pfdm
