#pragma once
// The JSON schema of case.toml for editors, made of the rows of keys. Draft 4, which taplo and "Even Better TOML" read:
// they complete keys, show what each is, and mark what the pattern of a quantity or a list of words excludes.

#include "cases/program/reference/key_tree.h"

#include <string>
#include <vector>

namespace pfdm {

/// A text that ends with a line break.
std::string key_schema(const std::vector<KindKeys>& kinds);

}  // namespace pfdm
