#pragma once
// pfdm list: the cases that ship, and every law, boundary condition and generator by name. Also what case was meant by
// a path that leads to none.

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>

namespace pfdm {

/// The directory of the cases that ship: beside an installed program, else in the checkout that it was built from.
std::filesystem::path shipped_cases();

/// A line for each directory with a case.toml, by kind and name: its name, its kind, how long the last complete run in
/// its results took, its title. Throws InputError if the directory is not there.
void list_cases(const std::filesystem::path& cases_directory, std::ostream& out);

void list_laws(std::ostream& out);

/// The case directory beside `where`, or among those that ship, whose name is nearest; nothing if none is near.
std::optional<std::string> nearest_case(const std::filesystem::path& where,
                                        const std::filesystem::path& cases_directory);

}  // namespace pfdm
