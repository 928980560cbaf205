#pragma once
// Reads a case of kind "chain": jobs of other cases one after the other, each of which may take numbers and files from
// the results of those before.

#include "cases/program/input/config/key.h"
#include "cases/program/session/runnable_case.h"
#include "solver/calibration/calibration_verdict.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// What a step can do with its case.
struct ChainJob {
  std::string_view name;
  std::string_view description;
  std::function<void(Session&)> RunnableCase::*job;
  std::string_view outcome;  ///< the file of the results that is written last, and that tells of the job
};
std::span<const ChainJob> chain_jobs();

/// The rows of the keys of kind "chain".
const KeyTable& chain_keys();

/// A number of a step's results that the chain's page shows.
struct ChainFigure {
  std::string says;
  std::string file;                   ///< in the step's results
  std::string key;                    ///< in that file, as in "isotropic.young_modulus_Pa"
  std::optional<std::string> unit;    ///< of the number; none: a number without one
  std::vector<ConfigValue> interval;  ///< keys of its lower and upper end; none: it has none
  ConfigValue place;                  ///< for messages
};

struct ChainStep {
  std::string name;
  std::filesystem::path where;  ///< of its case: a directory, or a .toml file in it
  bool outside = false;         ///< lies outside of the chain's folder, as it may
  const ChainJob* job = nullptr;
  Verdict accepted = worst_sound;  ///< the worst verdict on its fit with which the chain goes on
  std::vector<ChainFigure> figures;
  ConfigValue place;  ///< for messages
};

struct ChainCase {
  std::string title;
  std::vector<ChainStep> steps;
};

/// Whether a file or folder lies in a folder, links followed; neither need be there.
bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Steps' cases are not read here: what they take from earlier steps may not be there yet. Throws InputError also for a
/// step outside of the chain's folder that does not say so.
ChainCase read_chain_case(const ConfigTable& root, const std::filesystem::path& case_directory);

}  // namespace pfdm
