#pragma once
// A limit to the nesting of tables in a text, before it is parsed: parsers and what follows them recurse.

#include <cstddef>
#include <string>
#include <string_view>

namespace pfdm {

/// Most parts of a dotted key, as in "materials.glass.young_modulus", or of a table's name.
inline constexpr int most_key_parts = 32;

/// Where the string of TOML that begins at `at` with its quotes ends: behind the last of them, or at the end of the
/// text.
std::size_t end_of_string(std::string_view text, std::size_t at);

/// Throws InputError with the line of the first key with more parts in a TOML text; `shown_as` is its file in messages.
void refuse_deep_keys(std::string_view text, const std::string& shown_as);

}  // namespace pfdm
