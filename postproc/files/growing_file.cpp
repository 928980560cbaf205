#include "postproc/files/growing_file.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/descriptor.h"
#include "postproc/files/flush.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace pfdm {
namespace {

/// Opened for writing if it is as this program left it.
Descriptor open_unchanged(const std::filesystem::path& path, off_t size) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
  struct stat now {};
  const bool is_ours = file.is_open() && ::fstat(file.get(), &now) == 0 && S_ISREG(now.st_mode) && now.st_nlink == 1 &&
                       now.st_size == size;
  return is_ours ? std::move(file) : Descriptor(-1);
}

/// 0, or the reason why not all is written.
int write_at(const Descriptor& file, std::string_view content, off_t place) {
  while (!content.empty()) {
    const ssize_t n = ::pwrite(file.get(), content.data(), content.size(), place);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    content.remove_prefix(n);
    place += n;
  }
  return 0;
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path path, std::string_view content, std::string_view foot)
    : path_(std::move(path)), foot_(foot) {
  write_anew(content);
}

void GrowingFile::write_anew(std::string_view content) {
  const std::string whole = std::string(content) + foot_;
  write_file(path_, whole);
  size_ = static_cast<off_t>(whole.size());
}

void GrowingFile::append(std::string_view lines, const std::function<std::string()>& whole) {
  Descriptor file = open_unchanged(path_, size_);
  if (!file.is_open()) return write_anew(whole());
  const std::string added = std::string(lines) + foot_;
  const std::string_view over_foot = std::string_view(added).substr(0, foot_.size());
  const off_t foot_place = size_ - static_cast<off_t>(foot_.size());
  int error = write_at(file, std::string_view(added).substr(foot_.size()), size_);
  if (error == 0) error = write_at(file, over_foot, foot_place);
  if (error != 0) {
    write_at(file, foot_, foot_place);
    if (::ftruncate(file.get(), size_) != 0) size_ = -1;  // written anew the next time
    throw_cannot_write(path_, error);
  }
  file.close(path_);
  size_ += static_cast<off_t>(lines.size());
  flush_when_due(path_);
}

}  // namespace pfdm
