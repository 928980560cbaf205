#include "postproc/folder_lock.h"

#include "postproc/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace pfdm {

FolderLock::FolderLock(const std::filesystem::path& folder) : descriptor_(-1) {
  make_folder(folder);
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw ComputationError(fmt::format("cannot open {}: {}", folder.string(), std::generic_category().message(errno)));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw FolderInUse(
      fmt::format("{}: another run is writing its results there; wait for it, stop it, or choose another "
                  "folder with --output",
                  folder.string()));
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace pfdm
