#pragma once
// Rows for a script that follows a run: pfdm run --curve-to FILE.

#include "postproc/files/descriptor.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace pfdm {

class FollowedRows {
 public:
  /// Opens a file, which is written anew, or a pipe; nobody follows if the path is empty. Throws InputError if that
  /// cannot be.
  explicit FollowedRows(const std::filesystem::path& file);

  /// Writes lines. Of a pipe it waits until its reader has taken them, so that the run is no more than a step ahead of
  /// the script. Rows end where the reader is gone. Throws Interrupted if a signal comes meanwhile.
  void write(std::string_view lines);

 private:
  std::optional<Descriptor> file_;
};

}  // namespace pfdm
