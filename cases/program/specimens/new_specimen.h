#pragma once
// pfdm init --specimen: a new case of a standard specimen, from its dimensions and the records of its test.

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

struct SpecimenRequest {
  std::filesystem::path directory;               ///< new or empty
  std::string specimen;                          ///< "double_cantilever_beam"
  std::vector<std::filesystem::path> records{};  ///< CSV files of the testing machine
  std::vector<std::string> set{};                ///< NAME=VALUE
  std::filesystem::path cases;                   ///< the folder of cases that ship, with specimens/ and the schema
  std::string called_as = "pfdm";                ///< the program, in commands to be given next
};

/// Writes case.toml, README.md and the records. Says on `out` what was recognised, guessed and what comes next. Throws
/// InputError for what is wrong, before anything is written.
void make_specimen(const SpecimenRequest& request, std::ostream& out);

/// All specimens, a line each.
void list_specimens(const std::filesystem::path& cases, std::ostream& out);
/// Dimensions and properties of one with their defaults. Throws InputError if there is none of this name.
void list_specimen_values(const std::filesystem::path& cases, const std::string& specimen, std::ostream& out);

}  // namespace pfdm
