#include "cases/program/input/config/key_depth.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

bool is_in_bare_keys(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool is_long = text.substr(at, 3) == std::string(3, quote);
  const std::string_view closing = text.substr(at, is_long ? 3 : 1);
  std::size_t end = at + closing.size();
  while (end < text.size() && text.substr(end, closing.size()) != closing)
    end += text[end] == '\\' && quote == '"' ? 2 : 1;
  end += closing.size();
  for (int k = 0; k < 2 && is_long && end < text.size() && text[end] == quote; ++k) ++end;  // of its content
  return std::min(end, text.size());
}

void refuse_deep_keys(std::string_view text, const std::string& shown_as) {
  int line = 1, parts = 0;
  bool follows_dot = false;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    std::size_t end = at + 1;
    if (c == '#') {
      end = std::min(text.find('\n', at), text.size());
      parts = 0;
    } else if (c == '"' || c == '\'' || is_in_bare_keys(c)) {
      if (is_in_bare_keys(c))
        while (end < text.size() && is_in_bare_keys(text[end])) ++end;
      else
        end = end_of_string(text, at);
      parts = follows_dot ? parts + 1 : 1;
    } else if (c != '.' && c != ' ' && c != '\t') {
      parts = 0;
    }
    if (parts > most_key_parts)
      throw InputError(
          fmt::format("{}:{}: a key has more than {} parts with dots between them", shown_as, line, most_key_parts));
    follows_dot = c == '.' || (follows_dot && (c == ' ' || c == '\t'));
    line += static_cast<int>(std::count(text.begin() + at, text.begin() + end, '\n'));
    at = end;
  }
}

}  // namespace pfdm
