#pragma once
// A text file that grows by lines while a run goes on: each costs what it is long, however long the file is.

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace pfdm {

/// What is in the file stays where it is while lines come behind it. Killed in between, the file holds what it held,
/// and behind that the beginning of the new lines; with a foot, the new lines may have taken the first bytes of the
/// foot, whose last byte stays until they are whole.
class GrowingFile {
 public:
  /// Writes the file as write_file() does, and puts the foot at its end. Throws ComputationError that names the file
  /// and the reason, as append() does.
  GrowingFile(std::filesystem::path path, std::string_view content, std::string_view foot = {});

  /// Puts `lines` behind what is there, before the foot. A file that is gone, that somebody else has cut or extended,
  /// or that has a second name (a link), is written anew: what `whole` gives, the new lines included, without foot.
  /// Where the lines find no room the file holds what it held.
  void append(std::string_view lines, const std::function<std::string()>& whole);

 private:
  void write_anew(std::string_view content);

  std::filesystem::path path_;
  std::string foot_;
  off_t size_ = 0;  // foot included
};

}  // namespace pfdm
