#include "postproc/files/utf8.h"

#include <algorithm>

namespace pfdm {

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80U) return 1;
  if (first < 0xC2U || first > 0xF4U) return 0;
  const std::size_t length = first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
  if (text.size() < length) return 0;
  // The second byte excludes longer forms than needed, surrogates, and what is beyond the last character.
  const unsigned least = first == 0xE0U   ? 0xA0U
                         : first == 0xF0U ? 0x90U
                                          : 0x80U,
                 most = first == 0xEDU   ? 0x9FU
                        : first == 0xF4U ? 0x8FU
                                         : 0xBFU;
  if (byte(1) < least || byte(1) > most) return 0;
  return std::ranges::all_of(text.substr(2, length - 2), utf8_continues) ? length : 0;
}

std::size_t utf8_border(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size() && utf8_continues(text[at])) --at;
  return at;
}

}  // namespace pfdm
