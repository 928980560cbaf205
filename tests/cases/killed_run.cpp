#include "tests/cases/killed_run.h"

#include "solver/parallel.h"
#include "tests/cases/temporary_case.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace {

int changes_left = -1;  // negative: as many as it likes

void count_change() {
  if (changes_left >= 0 && changes_left-- == 0) ::raise(SIGKILL);
}

void count_change_of(const char* path) {
  if (changes_left >= 0 && ::access(path, F_OK) == 0) count_change();
}

}  // namespace

// These stand before the C library's own, for all of the executable.
extern "C" int rename(const char* from, const char* to) noexcept {
  count_change_of(from);
  return ::renameat(AT_FDCWD, from, AT_FDCWD, to);
}

extern "C" int remove(const char* path) noexcept {
  count_change_of(path);
  if (::unlinkat(AT_FDCWD, path, 0) == 0) return 0;
  return errno == EISDIR ? ::unlinkat(AT_FDCWD, path, AT_REMOVEDIR) : -1;
}

extern "C" ssize_t pwrite(int file, const void* from, std::size_t n, off_t place) noexcept {
  if (changes_left == 0) ::syscall(SYS_pwrite64, file, from, n / 2, place);  // killed in the middle of it
  count_change();
  return ::syscall(SYS_pwrite64, file, from, n, place);
}

namespace pfdm {

bool run_killed_after(int changes, const std::vector<std::string>& arguments) {
  set_threads(1);  // a process is copied without the threads of its pool
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child == 0) {
    changes_left = changes;
    ::_exit(run(arguments).status);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

}  // namespace pfdm
