#include "postproc/files/flush.h"

#include "physics/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Does `work` with a descriptor of the file or folder. What is gone needs no flush.
template <class Work>
void with_opened(const fs::path& path, const Work& work) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  const int error = work(fd) == 0 ? 0 : errno;
  ::close(fd);
  if (error != 0 && error != EINVAL && error != ENOSYS)  // pipes, and file systems that know no flush
    throw ComputationError(fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(error)));
}

void begin_flush([[maybe_unused]] const fs::path& path) {
#ifdef SYNC_FILE_RANGE_WRITE
  with_opened(path, [](int fd) { return ::sync_file_range(fd, 0, 0, SYNC_FILE_RANGE_WRITE); });
#endif
}

void flush(const fs::path& path) { with_opened(path, ::fsync); }

/// The files that wait, each once, in the order in which they were written last.
class WaitingFiles {
 public:
  void add(const fs::path& file) {
    const std::lock_guard lock(mutex_);
    const fs::path whole = fs::absolute(file);
    std::erase(files_, whole);
    files_.push_back(whole);
    if (budget_.is_due(Clock::now() - start_)) flush_all();
  }

  void flush_now() {
    const std::lock_guard lock(mutex_);
    flush_all();
  }

 private:
  void flush_all() {
    const Clock::time_point begin = Clock::now();
    const std::vector<fs::path> files = std::exchange(files_, {});
    std::vector<fs::path> folders;
    for (const fs::path& file : files) {
      begin_flush(file);  // all of them first: the disk then takes them together
      if (std::ranges::find(folders, file.parent_path()) == folders.end()) folders.push_back(file.parent_path());
    }
    std::ranges::for_each(files, flush);
    std::ranges::for_each(folders, flush);
    budget_.add(Clock::now() - begin);
  }

  std::mutex mutex_;
  std::vector<fs::path> files_;
  FlushBudget budget_;
  Clock::time_point start_ = Clock::now();
};

WaitingFiles& waiting_files() {
  static WaitingFiles files;
  return files;
}

}  // namespace

void flush_when_due(const fs::path& file) { waiting_files().add(file); }

void flush_written_files() { waiting_files().flush_now(); }

}  // namespace pfdm
