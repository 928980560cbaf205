#pragma once
// Keeps two runs from writing into one folder of results.

#include <filesystem>

namespace pfdm {

class FolderLock {
 public:
  /// Makes the folder if need be. Throws InputError if another run holds it, ComputationError if it cannot be made or
  /// opened. Where the file system knows no locks there is none. A killed run holds nothing.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace pfdm
