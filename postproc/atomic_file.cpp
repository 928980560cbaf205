#include "postproc/atomic_file.h"

#include "physics/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int reason) {
  throw ComputationError(fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(reason)));
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, const fs::path& shown) : fd_(::open(path.c_str(), flags, 0666)) {
    if (fd_ < 0) fail(shown, errno);
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }
  // Network file systems may report a full disk only here.
  void sync_and_close(const fs::path& shown) {
    if (::fsync(fd_) != 0 && errno != EINVAL) fail(shown, errno);
    const int closed = ::close(fd_);
    fd_ = -1;
    if (closed != 0) fail(shown, errno);
  }

 private:
  int fd_;
};

// Leaves no temporary file behind, whatever happens; after the renaming there is none to remove.
struct TemporaryFile {
  fs::path path;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

// The same name each time, so that what a killed run left behind is overwritten and does not pile up.
fs::path temporary_name(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.partial", path.filename().string());
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

void rename_into_place(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, errno);
  Descriptor(folder_of(path), O_RDONLY | O_DIRECTORY, path).sync_and_close(path);
}

}  // namespace

void write_file(const fs::path& path, std::string_view content) {
  const TemporaryFile temporary{temporary_name(path)};
  Descriptor file(temporary.path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, path);
  detail::write_all(file.get(), content, path);
  file.sync_and_close(path);
  rename_into_place(temporary.path, path);
}

void replace_file(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const TemporaryFile temporary{temporary_name(path)};
  write(temporary.path);
  Descriptor(temporary.path, O_RDONLY | O_CLOEXEC, path).sync_and_close(path);
  rename_into_place(temporary.path, path);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw ComputationError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

namespace detail {

void write_all(int descriptor, std::string_view content, const fs::path& path) {
  while (!content.empty()) {
    const ssize_t n = ::write(descriptor, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, errno);
    content.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace detail
}  // namespace pfdm
