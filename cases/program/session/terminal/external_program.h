#pragma once
// Other programs of the machine, run to their end.

#include <string>
#include <vector>

namespace pfdm {

/// The word as one argument of a shell command, whatever is in it.
std::string quoted(const std::string& word);

/// Whether PATH leads to a program of this name.
bool is_installed(const std::string& program);

struct ProgramEnd {
  int status = 0;  ///< its exit status; -1 if it was killed
  std::string out;
  std::string err;
};

/// Runs `words`, the first of which is a program on PATH. Throws ComputationError if it cannot be started.
ProgramEnd run_external(const std::vector<std::string>& words);

}  // namespace pfdm
