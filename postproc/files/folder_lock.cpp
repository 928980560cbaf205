#include "postproc/files/folder_lock.h"

#include "postproc/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
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

/// The first bytes of a file; empty for what is no file that may be read.
std::string head_of(const fs::path& path) {
  std::string head(4096, '\0');
  std::ifstream in;
  if (fs::is_regular_file(path)) in.open(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

/// A log begins with the time and the program's name.
bool begins_a_log(std::string_view head) {
  constexpr std::string_view time = "0000-00-00 00:00:00";
  if (head.size() < time.size() || !head.substr(time.size()).starts_with(" pfdm ")) return false;
  return std::ranges::equal(head.substr(0, time.size()), time,
                            [](char c, char due) { return due == '0' ? c >= '0' && c <= '9' : c == due; });
}

/// Whether a file's content, not its name alone, tells that this program has written it.
bool is_result(const fs::path& path) {
  const fs::path name = path.filename();
  if (name == "checkpoint.bin") return head_of(path).starts_with("PFDMCKPT");
  if (name == "case.toml") return head_of(path).starts_with("# Kept by pfdm ");
  if (name.extension() == ".log") return begins_a_log(head_of(path));
  if (path.parent_path().filename() == "cohesive_law") return head_of(path).find("pfdm ") != std::string::npos;
  return name.extension() == ".json" && head_of(path).find("\"case_hash\": \"") != std::string::npos;
}

/// Whether the folder is marked, or holds a file of results, also of a version that did not mark its folders.
bool is_ours(const fs::path& folder) {
  if (fs::is_regular_file(folder / owned_folder_mark)) return true;
  for (const fs::path& place : {folder, folder / "analysis", folder / "cohesive_law"})
    if (fs::is_directory(place) && std::ranges::any_of(fs::directory_iterator(place), is_result)) return true;
  return false;
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
  if (!other || is_ours(folder)) return;
  if (fs::is_regular_file(folder / "case.toml"))
    throw InputError(
        fmt::format("{} is the folder of a case, and holds files that are not of pfdm: choose another one "
                    "with --output, as results in it",
                    folder.string()));
  throw InputError(fmt::format(
      "{} holds files that are not of pfdm, as \"{}\": choose another folder with --output; an empty file {} "
      "in it says that files may be replaced there",
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
