#pragma once
// pfdm help WORD: what keys, commands and options tell of words that are not the name of a command.

#include "cases/program/reference/key_tree.h"

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

/// `kinds`: of all keys that the program knows; those of fracture cases come first. `guides`: the folder of the pages
/// whose names may tell of it, too. Throws InputError with names that are spelled like `asked` where nothing does.
void help_on(const std::string& asked, std::vector<KindKeys> kinds, const std::filesystem::path& guides,
             std::ostream& out);

/// After the help of a command: how to ask for the table that has its name; nothing where none has.
void help_on_keys_beside(const std::string& command, const std::vector<KindKeys>& kinds, std::ostream& out);

}  // namespace pfdm
