#pragma once
// Keeps two runs from writing into one folder of results.

#include "physics/error.h"

#include <filesystem>

namespace pfdm {

/// An empty file in each folder of results.
constexpr const char* owned_folder_mark = ".pfdm";

/// Puts it there. Throws ComputationError if that cannot be.
void mark_folder(const std::filesystem::path& folder);

/// Another run holds the folder.
struct FolderInUse : InputError {
  using InputError::InputError;
};

class FolderLock {
 public:
  /// Makes the folder if need be, marks it as one whose files may be replaced, and removes temporary files that killed
  /// runs left in it. Throws FolderInUse if another run holds it, InputError if it holds files but neither
  /// the mark nor results, which their content tells (logs, JSON with a case_hash, checkpoints), or a link to a folder,
  /// ComputationError that names --output if it cannot be made, opened or written to. Where the file system knows no
  /// locks there is none. A killed run holds nothing.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace pfdm
