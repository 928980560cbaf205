#pragma once
// Text of files, names and messages, which may be in UTF-8 or in anything else.

#include <cstddef>
#include <string_view>

namespace pfdm {

/// Bytes of the character of UTF-8 (RFC 3629) with which the text begins; 0 where it begins with none.
std::size_t utf8_length(std::string_view text);

/// Whether a byte goes on with a character of UTF-8 that others began.
inline bool utf8_continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Where no character is cut, at `at` or before.
std::size_t utf8_border(std::string_view text, std::size_t at);

}  // namespace pfdm
