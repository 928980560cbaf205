#include "postproc/files/folder_lock.h"

#include "postproc/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace pfdm {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw ComputationError(what + "; --output DIR puts the results elsewhere");
}

// Found out now, not when there is something to write.
void require_writable(const std::filesystem::path& folder) {
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    fail(fmt::format("cannot write into {}: {}", folder.string(), std::generic_category().message(errno)));
}

void make(const std::filesystem::path& folder) {
  try {
    make_folder(folder);
  } catch (const ComputationError& error) {
    fail(error.what());
  }
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  make(folder);
  require_writable(folder);
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) fail(fmt::format("cannot open {}: {}", folder.string(), std::generic_category().message(errno)));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw FolderInUse(
        fmt::format("{}: another run is writing its results there; wait for it, stop it, or choose another "
                    "folder with --output",
                    folder.string()));
  }
  remove_leftovers(folder);
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace pfdm
