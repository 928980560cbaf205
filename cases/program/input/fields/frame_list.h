#pragma once
// ParaView's lists of files with times (.pvd), as any program writes them.

#include <filesystem>
#include <vector>

namespace pfdm {

struct ListedFrame {
  double time = 0.0;  ///< in the list's unit
  std::filesystem::path file;
};

/// In order of time; paths start at the list. Throws InputError naming the list where it has no frames, one of them
/// lacks time or file, or two have one time.
std::vector<ListedFrame> read_frame_list(const std::filesystem::path& path);

}  // namespace pfdm
