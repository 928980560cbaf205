#pragma once
// What the command line asked for, and where to say things.

#include "cases/program/log.h"
#include "physics/tensor.h"

#include <filesystem>
#include <optional>
#include <string>

namespace pfdm {

struct Session {
  std::filesystem::path results;   ///< directory
  bool restart = false;            ///< go on from the last complete output
  std::optional<Index> max_steps;  ///< stop after so many steps of this run
  int threads = 1;
  std::string version;
  Log& log;
};

}  // namespace pfdm
