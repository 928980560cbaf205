#pragma once
// The manual page pfdm.1.

#include "cases/program/commands.h"

#include <span>
#include <string>

namespace pfdm {

/// Source of the page for man (macros of the package man, groff_man(7)), made of the help texts of the commands.
std::string manual_page(std::span<const CommandWords> commands, const std::string& version);

}  // namespace pfdm
