#pragma once
// What a row of a key says, in words for people.

#include "cases/program/input/config/key.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// "stress, as in \"75 MPa\", positive; or { expr, unit }"
std::string words_of(const KeyType& type);
/// The default in words, or that the key is required.
std::string default_in_words(const Key& key);
/// The keys of which just one is required with this one, itself first: those that its default names, as "or patches" of
/// `patch`. Empty: there are none.
std::vector<std::string_view> one_of_which_is_required(const Key& key, const KeyTable& table);
/// A line of TOML with the key, as an example.
std::string example_line(const Key& key);

}  // namespace pfdm
