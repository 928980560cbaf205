#pragma once
// What a row of a key says, in words for people.

#include "cases/program/input/key.h"

#include <string>

namespace pfdm {

/// "stress, as in \"75 MPa\", positive; or { expr, unit }"
std::string words_of(const KeyType& type);
/// The default in words, or that the key is required.
std::string default_in_words(const Key& key);
/// A line of TOML with the key, as an example.
std::string example_line(const Key& key);

}  // namespace pfdm
