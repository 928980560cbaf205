#pragma once
// Keys by words of what they are for, where no key has the word as its name.

#include "cases/program/reference/key_tree.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// What the rows say of the keys with this name or path (help_on_key), and which others tell of it. Where no key has it
/// as its name, those whose name, sentence or values have all the words of `asked`, small or capital, singular or
/// plural, or else words that begin so (four letters or more), or else most of several words. Nothing if there are
/// none.
std::optional<std::string> help_on_word(const std::string& asked, const std::vector<KindKeys>& kinds);

/// Whether a text has all the words of `asked`, small or capital, singular or plural.
bool tells_of(std::string_view text, std::string_view asked);

/// Each once, in the order of letters.
std::vector<std::string> names_of_keys(const std::vector<KindKeys>& kinds);

}  // namespace pfdm
