#include "postproc/files/folder_lock.h"

#include "postproc/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>

namespace pfdm {

namespace {

namespace fs = std::filesystem;

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

/// Whether a run, a fit, a mesh or an export has written there, also one of a version that did not mark its folders, or
/// the folder is that of a case.
bool holds_results(const fs::path& folder) {
  constexpr const char* signs[] = {owned_folder_mark, "run.log",         "summary.json",  "fit.json",
                                   "chain.json",      "comparison.json", "compared.json", "sweep.csv",
                                   "mesh.vtu",        "checkpoint.bin",  "case.toml",     "cohesive_law",
                                   "report",          "history.csv",     "analysis",      "force_displacement.csv"};
  return std::ranges::any_of(signs, [&](const char* sign) { return fs::exists(folder / sign); });
}

/// Links to folders within, whose targets a new run would empty, and folders of others.
void require_ours(const fs::path& folder) {
  std::optional<std::string> other;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_symlink() && entry.is_directory())
      throw InputError(
          fmt::format("{} is a link to a folder, whose files a run would replace: remove it; the folder of results "
                      "itself may be a link",
                      entry.path().string()));
    other = std::min(other.value_or("\xff"), entry.path().filename().string());
  }
  if (other && !holds_results(folder))
    throw InputError(
        fmt::format("{} holds files that are not of pfdm, as \"{}\": choose another folder with --output; an empty "
                    "file {} in it says "
                    "that files may be replaced there",
                    folder.string(), *other, owned_folder_mark));
}

}  // namespace

void mark_folder(const fs::path& folder) {
  const fs::path mark = folder / owned_folder_mark;
  const int descriptor = ::open(mark.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(fmt::format("cannot write {}: {}", mark.string(), std::generic_category().message(errno)));
  ::close(descriptor);
}

FolderLock::FolderLock(const std::filesystem::path& folder) {
  make(folder);
  require_writable(folder);
  require_ours(folder);
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
  mark_folder(folder);
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace pfdm
