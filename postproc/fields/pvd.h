#pragma once
// fields.pvd: the list of frames, in order of time, that ParaView opens as one animation.

#include "postproc/files/growing_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pfdm {

struct Frame {
  double time = 0.0;  ///< what ParaView takes for it: the load parameter, or another number that rises
  std::string file;   ///< relative to the .pvd
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// What a killed run has begun to add to the list is left out. Throws InputError if the file cannot be read or is not
/// one of ours.
std::vector<Frame> read_pvd(const std::filesystem::path& path);

/// A list of frames whose file has all of them after each change.
class PvdSeries {
 public:
  /// Starts a list without frames. Throws ComputationError if the file cannot be written, as add() does.
  explicit PvdSeries(std::filesystem::path path);
  /// Continues a list on the disk, of which the frames that `keeps` says are kept; without a file, from none.
  /// Throws InputError likewise to read_pvd.
  PvdSeries(std::filesystem::path path, const std::function<bool(const Frame&)>& keeps);

  void add(double time, const std::string& file);
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  std::string text() const;

  std::vector<Frame> frames_;
  GrowingFile file_;
};

}  // namespace pfdm
