#pragma once
// Completion of commands, options, case directories and names of keys by the shell.

#include "cases/program/commands.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The script for "bash" or "zsh"; throws InputError for another shell. `keys`: names that `pfdm help` takes as well.
std::string completion_script(std::string_view shell, const std::vector<CommandWords>& commands,
                              const std::vector<std::string>& keys);

}  // namespace pfdm
