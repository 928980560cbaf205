#pragma once
// pfdm list: the cases that ship, and every law, boundary condition and generator by name.

#include <filesystem>
#include <ostream>

namespace pfdm {

/// A line for each directory with a case.toml: its name and its title. Throws InputError if the directory is not there.
void list_cases(const std::filesystem::path& cases_directory, std::ostream& out);

void list_laws(std::ostream& out);

}  // namespace pfdm
