#pragma once
// pfdm help KEY: what a key is, what may stand there, its default, where it stands.

#include "cases/program/reference/key_tree.h"

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// What the rows say of the keys that `asked` names: a name as "toughness", or the end of a path as
/// "materials.poisson_ratio"; names that the user chooses and numbers of list elements may be left out. Nothing if
/// there is no such key.
std::optional<std::string> help_on_key(const std::string& asked, const std::vector<KindKeys>& kinds);

/// Names of keys that are spelled like `asked`, the nearest first.
std::vector<std::string> keys_like(const std::string& asked, const std::vector<KindKeys>& kinds);

}  // namespace pfdm
