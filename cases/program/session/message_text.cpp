#include "cases/program/session/message_text.h"

#include "postproc/files/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

bool continues(unsigned char byte) { return (byte & 0xC0U) == 0x80U; }

std::string with_shown_bytes(std::string_view message) {
  std::string text;
  while (!message.empty()) {
    const auto byte = static_cast<unsigned char>(message.front());
    const std::size_t length = utf8_length(message);
    if (byte == '\n' || byte == '\t')
      text += ' ';
    else if (length == 0 || byte < 0x20U || byte == 0x7FU)
      text += fmt::format("\\x{:02x}", byte);
    else
      text += message.substr(0, length);
    message.remove_prefix(std::max<std::size_t>(1, length));
  }
  return text;
}

/// Where no character is cut, at `at` or before.
std::size_t border(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size() && continues(static_cast<unsigned char>(text[at]))) --at;
  return at;
}

std::string with_ends_kept(std::string_view text, std::size_t first, std::size_t last) {
  return fmt::format("{} ... {} ({} bytes)", text.substr(0, border(text, first)),
                     text.substr(border(text, text.size() - last)), text.size());
}

std::string shortened_word(std::string_view word) {
  constexpr std::size_t longest_word = 120, longest_path = 250;
  const bool is_path = word.find('/') != std::string_view::npos;
  const std::size_t longest = is_path ? longest_path : longest_word;
  return word.size() <= longest ? std::string(word) : with_ends_kept(word, longest / 3, longest / 3);
}

}  // namespace

std::string message_text(std::string_view message) {
  constexpr std::size_t longest = 2000, first_kept = 1400, last_kept = 500;
  const std::string shown = with_shown_bytes(message);
  std::string text;
  for (std::size_t at = 0; at < shown.size();) {
    const std::size_t blank = std::min(shown.find(' ', at), shown.size());
    text += shortened_word(std::string_view(shown).substr(at, blank - at));
    if (blank < shown.size()) text += ' ';
    at = blank + 1;
  }
  return text.size() <= longest ? text : with_ends_kept(text, first_kept, last_kept);
}

}  // namespace pfdm
