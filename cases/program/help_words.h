#pragma once
// pfdm help WORD: what keys, commands and options tell of words that are not the name of a command.

#include "cases/program/reference/key_tree.h"

#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

/// `kinds`: of all keys that the program knows. Throws InputError with names that are spelled like `asked` where
/// nothing tells of it.
void help_on(const std::string& asked, const std::vector<KindKeys>& kinds, std::ostream& out);

}  // namespace pfdm
