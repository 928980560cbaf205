#pragma once
// Computations of a foreign library in a process of their own, so that its crash does not end the program.

#include <functional>
#include <optional>
#include <string>

namespace pfdm {

/// Bytes that `compute` returns, computed in a forked copy of this process; nothing where that process crashed.
/// An exception of `compute` is thrown here, as InputError if it was one, else as ComputationError. `compute` may read
/// everything but start no threads; what it writes to memory is lost. Throws ComputationError where no process can be
/// started.
std::optional<std::string> computed_separately(const std::function<std::string()>& compute);

}  // namespace pfdm
