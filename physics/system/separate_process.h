#pragma once
// Computations of a foreign library in a process of their own, so that its crash does not end the program, and neither
// do its loops and allocations without end.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace pfdm {

/// Limits of the process; without limits it may use as much as the machine gives.
struct ProcessLimits {
  double seconds = std::numeric_limits<double>::infinity();         ///< of a processor
  std::size_t bytes = std::numeric_limits<std::size_t>::max() / 2;  ///< of memory, beside what this process has
};

/// Bytes that `compute` returns, computed in a forked copy of this process; nothing where that process crashed or
/// reached a limit. An exception of `compute` is thrown here, as InputError if it was one, else as ComputationError.
/// `compute` may read everything but start no threads; what it writes to memory is lost. Throws ComputationError where
/// no process can be started.
std::optional<std::string> computed_separately(const std::function<std::string()>& compute,
                                               const ProcessLimits& limits = {});

/// Answer of `read`, run in a process of its own, which reads a file with a foreign library. Time and memory are
/// limited; they grow with the file and allow for its compression. Throws InputError, `named` and what is wrong, where
/// the reader crashed or reached a limit.
std::string read_separately(const std::filesystem::path& file, std::string_view named,
                            const std::function<std::string()>& read);

}  // namespace pfdm
