#pragma once
// pfdm init: a new case directory from one that is there.

#include <filesystem>
#include <ostream>

namespace pfdm {

/// Copies case.toml of `like` with a title to be edited, and the data files that it names, to `directory`, and begins a
/// README.md; results stay where they are. Files outside of the case go to data/. Says on `out` what there is now.
/// Throws InputError if the directory holds something already, or if `like` is no case.
void make_case(const std::filesystem::path& directory, const std::filesystem::path& like, std::ostream& out);

/// Throws InputError if `directory` is a file, or a folder that holds something.
void require_empty(const std::filesystem::path& directory);

}  // namespace pfdm
