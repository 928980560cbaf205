#include "cases/program/session/terminal/followed_rows.h"

#include "cases/program/session/terminal/stop_signal.h"
#include "physics/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace pfdm {
namespace {

bool is_gone(int pipe) {
  pollfd end{.fd = pipe, .events = POLLOUT, .revents = 0};
  return ::poll(&end, 1, 0) < 0 || (end.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0;
}

/// Of a regular file nothing waits.
bool is_read(int file) {
  int waiting = 0;
  return ::lseek(file, 0, SEEK_CUR) >= 0 || ::ioctl(file, FIONREAD, &waiting) != 0 || waiting == 0;
}

}  // namespace

FollowedRows::FollowedRows(const std::filesystem::path& file) {
  if (file.empty()) return;
  file_.emplace(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file_->is_open()) throw InputError(fmt::format("--curve-to {}: this file cannot be written", file.string()));
}

void FollowedRows::write(std::string_view lines) {
  while (file_ && !lines.empty()) {
    const ssize_t n = ::write(file_->get(), lines.data(), lines.size());
    if (n < 0 && errno == EINTR) {
      stop_if_asked();
      continue;
    }
    if (n < 0) {
      file_.reset();
      return;
    }
    lines.remove_prefix(n);
  }
  while (file_ && !is_read(file_->get())) {
    stop_if_asked();
    if (is_gone(file_->get())) file_.reset();
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace pfdm
