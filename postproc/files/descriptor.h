#pragma once
// An open file of the system's own kind, closed at the end of its scope.

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

namespace pfdm {

/// Throws ComputationError that names the file and the reason, an errno.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, int reason);

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;

  bool is_open() const { return fd_ >= 0; }
  int get() const { return fd_; }
  /// Throws as throw_cannot_write() does: network file systems may report a full disk only here.
  void close(const std::filesystem::path& shown) {
    if (::close(std::exchange(fd_, -1)) != 0) throw_cannot_write(shown, errno);
  }

 private:
  int fd_;
};

}  // namespace pfdm
