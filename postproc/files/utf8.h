#pragma once
// Text of files, names and messages, which may be in UTF-8 or in anything else.

#include <cstddef>
#include <string_view>

namespace pfdm {

/// Bytes of the character of UTF-8 (RFC 3629) with which the text begins; 0 where it begins with none.
std::size_t utf8_length(std::string_view text);

}  // namespace pfdm
