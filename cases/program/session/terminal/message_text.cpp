#include "cases/program/session/terminal/message_text.h"

#include "postproc/files/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

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

std::string with_ends_kept(std::string_view text, std::size_t first, std::size_t last) {
  return fmt::format("{} ... {} ({} bytes)", text.substr(0, utf8_border(text, first)),
                     text.substr(utf8_border(text, text.size() - last)), text.size());
}

/// How long words may be, and paths.
struct Lengths {
  std::size_t word, path;
  bool (*is_path)(std::string_view word);
};

std::string shortened_word(std::string_view word, const Lengths& lengths) {
  const std::size_t longest = lengths.is_path(word) ? lengths.path : lengths.word;
  return word.size() <= longest ? std::string(word) : with_ends_kept(word, longest / 3, longest / 3);
}

template <class Visit>
void for_each_word(std::string_view text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t blank = std::min(text.find(' ', at), text.size());
    visit(text.substr(at, blank - at), blank < text.size());
    at = blank + 1;
  }
}

std::string with_short_words(std::string_view shown, const Lengths& lengths) {
  std::string text;
  for_each_word(shown, [&](std::string_view word, bool goes_on) {
    text += shortened_word(word, lengths);
    if (goes_on) text += ' ';
  });
  return text;
}

bool begins_at_the_root(std::string_view word) { return word.starts_with('/'); }
bool has_a_slash(std::string_view word) { return word.find('/') != std::string_view::npos; }

/// Bytes of the folders of files that a text names by their whole paths.
std::size_t size_of_folders(std::string_view text) {
  std::size_t sum = 0;
  for_each_word(text, [&](std::string_view word, bool) { sum += begins_at_the_root(word) ? word.rfind('/') : 0; });
  return sum;
}

std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

/// The longest list of what there is, from its bracket to before its end, as "(allowed: a, b, c".
std::string_view longest_list(std::string_view text) {
  std::string_view longest;
  for (const std::string_view head : {"(allowed: ", "(available: ", "(there is: ", "(there are: "})
    for (std::size_t begin = text.find(head); begin != std::string_view::npos; begin = text.find(head, begin + 1)) {
      const std::size_t end = text.find(')', begin);
      if (end != std::string_view::npos && end - begin > longest.size()) longest = text.substr(begin, end - begin);
    }
  return longest;
}

/// Leaves out the last of such a list, so many as are too long; the rest of the message stays.
std::string with_short_list(const std::string& text, std::size_t longest) {
  const std::string_view list = longest_list(text);
  if (text.size() <= longest || list.empty()) return text;
  const std::size_t too_much = text.size() - longest + std::string_view(", ... 999 more").size();
  const std::size_t cut = list.rfind(", ", list.size() - std::min(too_much, list.size()));
  if (cut == std::string_view::npos) return text;
  const auto begin = static_cast<std::size_t>(list.data() - text.data());
  return fmt::format("{}, ... {} more{}", text.substr(0, begin + cut), count_of(list.substr(cut), ", "),
                     text.substr(begin + list.size()));
}

constexpr std::size_t longest = 290;  // beside the folders of files

/// Leaves out the middle, between words, of what is still too long.
std::string with_short_middle(const std::string& text) {
  constexpr std::string_view gap = " ... ";
  const std::size_t most = longest + size_of_folders(text);
  if (text.size() <= most) return text;
  const std::size_t last = most / 3, end = text.find(' ', text.size() - last);
  const std::size_t first = text.rfind(' ', most - last - gap.size());
  if (end == std::string::npos || first == std::string::npos)
    return fmt::format("{}{}{}", text.substr(0, utf8_border(text, most - last - gap.size())), gap,
                       text.substr(utf8_border(text, text.size() - last)));
  return fmt::format("{}{}{}", text.substr(0, first), gap, text.substr(end + 1));
}

}  // namespace

std::string message_text(std::string_view message) {
  constexpr Lengths usual{120, 250, has_a_slash}, tight{45, 250, begins_at_the_root};
  constexpr std::size_t longest_of_all = 2000, first_kept = 1400, last_kept = 500;
  const std::string shown = with_shown_bytes(message);
  std::string text = with_short_words(shown, usual);
  if (text.size() > longest + size_of_folders(text)) text = with_short_words(shown, tight);
  text = with_short_list(text, longest + size_of_folders(text));
  return text.size() <= longest_of_all ? text : with_ends_kept(text, first_kept, last_kept);
}

std::string error_text(std::string_view message) { return with_short_middle(message_text(message)); }

}  // namespace pfdm
