#include "postproc/files/csv_words.h"

#include "postproc/files/text_file.h"

#include <algorithm>
#include <cctype>

namespace pfdm {
namespace {

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

/// "1.032,66" -> "1032,66"; nothing unless groups of three digits follow one of up to three.
std::optional<std::string> with_joined_thousands(std::string_view word, char decimal, char thousands) {
  const std::size_t end = std::min(word.find(decimal), word.size());
  std::string joined;
  std::size_t digits = 0;  // since the last mark
  bool apart = false;
  for (const char c : word.substr(0, end)) {
    if (c == thousands) {
      if (digits == 0 || digits > 3 || (apart && digits != 3)) return std::nullopt;
      apart = true;
      digits = 0;
      continue;
    }
    digits += std::isdigit(static_cast<unsigned char>(c)) != 0 ? 1 : 0;
    joined += c;
  }
  if (apart && digits != 3) return std::nullopt;
  return joined.append(word.substr(end));
}

}  // namespace

void split_csv(std::string_view line, char separator, std::vector<std::string>& words) {
  words.clear();
  if (separator == ' ') line = trimmed(line);
  for (;;) {
    const std::size_t end = end_of_entry(line, separator);
    words.push_back(unquoted(trimmed(line.substr(0, end))));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (separator == ' ') line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  }
}

std::optional<double> csv_number(std::string_view word, char decimal, std::optional<char> thousands) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  if (thousands && word.find(*thousands) != std::string_view::npos) {
    const auto joined = with_joined_thousands(word, decimal, *thousands);
    return joined ? csv_number(*joined, decimal) : std::nullopt;
  }
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos)
    return decimal == ',' && word.find('.') != std::string_view::npos ? std::nullopt : parse_double(word);
  if (decimal != ',' || comma + 1 == word.size() || word.find('.') != std::string_view::npos) return std::nullopt;
  std::string with_point(word);
  with_point[comma] = '.';
  return parse_double(with_point);
}

bool is_gap(std::string_view word) {
  constexpr std::string_view words[] = {"", "nan", "na", "n/a", "#n/a", "null", "none"};
  return std::ranges::find(words, lower_case(word)) != std::end(words);
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

}  // namespace pfdm
