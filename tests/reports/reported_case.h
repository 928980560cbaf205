#pragma once
// The inputs of tests/reports, each run in a folder of its own.

#include "tests/cases/temporary_case.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace pfdm {

/// A copy of a folder of tests/reports, in a directory that goes away with the object.
class ReportedCase {
 public:
  /// `folder`: relative to tests/reports, as in "30_J_and_K/half".
  explicit ReportedCase(const std::string& folder);

  const std::filesystem::path& path() const { return directory_.path(); }
  std::filesystem::path results() const { return directory_.results(); }

  /// What `pfdm COMMAND` on the folder does, or on its file `file`.
  Outcome run(const std::string& command, const std::string& file = "case.toml") const;

  /// A file of JSON in the results, as in "summary.json".
  nlohmann::json json(const std::string& file) const;

 private:
  TemporaryCase directory_;
};

}  // namespace pfdm
