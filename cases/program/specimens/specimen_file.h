#pragma once
// A specimen as its file in cases/specimens describes it: dimensions, what follows from them, text of case.toml.

#include "cases/program/input/config/units.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

/// A dimension or property of a specimen, which --set changes.
struct SpecimenValue {
  std::string name;
  const Dimension* due = nullptr;
  std::string text;                ///< default, with its unit
  std::string what;                ///< a sentence
  std::string guess{};             ///< what data reduction says of it: "toughness" or a constant, as "E_flexural"
  double least = 0.0, most = 0.0;  ///< open ends of what is allowed; no upper one where both are 0
};

struct SpecimenRule {
  std::string that;       ///< formula that is not zero where all is well
  std::string message;    ///< what is wrong otherwise
  bool is_doubt = false;  ///< told, and not refused
};

struct SpecimenFile {
  std::string name, title, standard;
  std::vector<SpecimenValue> values{};
  std::vector<std::pair<std::string, std::string>> derived{};  ///< name and formula, in their order
  std::vector<SpecimenRule> rules{};
  bool takes_toe = true;    ///< slack of records is taken off
  std::string share{};      ///< formula: which part of the specimen is computed; empty: all of it
  std::string case_text{};  ///< of case.toml, with {{ formula : unit }} in it
  std::string reduction{};  ///< of [experiment.reduction]; empty: there is none
  std::string fit_text{};   ///< of [fit], where there is a record
  std::string readme{};     ///< of README.md
};

/// Names of all specimens, in the order in which they are listed.
std::vector<std::string> specimen_names(const std::filesystem::path& cases_directory);

/// Throws InputError, with the nearest name, where there is none.
SpecimenFile read_specimen_file(const std::filesystem::path& cases_directory, const std::string& name);

}  // namespace pfdm
