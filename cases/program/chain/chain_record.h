#pragma once
// chain.json: what the steps of a chain have done, and from what.

#include "cases/program/input/case_files/case_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

struct ShownFigure {
  std::string says;
  double value = 0.0;
  std::string unit;                ///< empty: a number without one
  std::vector<double> interval{};  ///< its ends; empty if it has none
};

/// A step that is done.
struct DoneStep {
  std::string name;
  std::string does;
  std::string key;                   ///< hash of the case, of its data files and of the numbers that it took
  std::string outcome;               ///< hash of the file that tells of the job
  double wall_seconds = 0.0;         ///< that the job took
  std::string verdict{};             ///< on a fit
  std::vector<TakenNumber> taken;    ///< from results of earlier steps
  std::vector<std::string> files{};  ///< likewise
  std::vector<ShownFigure> figures{};
};

struct ChainRecord {
  std::string case_name;
  std::string status;  ///< "complete", or what is missing
  std::string version;
  std::vector<DoneStep> steps;
  const DoneStep* find(const std::string& name) const;
};

inline constexpr const char* chain_file = "chain.json";

/// Written whole or not at all. Throws ComputationError.
void write_chain(const std::filesystem::path& results, const ChainRecord& record);

/// Empty if there is none. Throws InputError for a file that is none.
ChainRecord read_chain(const std::filesystem::path& results);

}  // namespace pfdm
