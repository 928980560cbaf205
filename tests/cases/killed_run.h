#pragma once
// The program in a process of its own, which kills itself (SIGKILL) before it changes the disk once more.

#include <string>
#include <vector>

namespace pfdm {

/// Runs the program; when it has renamed, removed or extended `changes` files it is killed before the next, or when
/// half of that extension is written. Whether it was killed, that is, did not end before.
bool run_killed_after(int changes, const std::vector<std::string>& arguments);

}  // namespace pfdm
