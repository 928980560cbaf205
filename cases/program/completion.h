#pragma once
// Completion of commands, options and case directories by the shell.

#include "cases/program/commands.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The script for "bash" or "zsh"; throws InputError for another shell.
std::string completion_script(std::string_view shell, const std::vector<CommandWords>& commands);

}  // namespace pfdm
