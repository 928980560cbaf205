#include "physics/system/separate_process.h"

#include "physics/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

namespace pfdm {
namespace {

// First byte of an answer, by its kind.
constexpr char result = 'r', wrong_input = 'i', failure = 'f';

/// Empty where memory did not suffice.
std::string answer_of(const std::function<std::string()>& compute) {
  try {
    return result + compute();
  } catch (const std::bad_alloc&) {
    return "";
  } catch (const InputError& error) {
    return wrong_input + std::string(error.what());
  } catch (const std::exception& error) {
    return failure + std::string(error.what());
  }
}

bool write_all(int pipe, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(pipe, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return true;
}

std::string read_all(int pipe) {
  std::string bytes;
  std::array<char, 1 << 16> part{};
  while (true) {
    const ssize_t n = ::read(pipe, part.data(), part.size());
    if (n == 0 || (n < 0 && errno != EINTR)) return bytes;
    if (n > 0) bytes.append(part.data(), static_cast<std::size_t>(n));
  }
}

void lower(decltype(RLIMIT_CPU) resource, rlim_t most) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  limit.rlim_max = std::min(limit.rlim_max, most);
  ::setrlimit(resource, &limit);
}

/// The addresses that this process has in use.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void keep_to(const ProcessLimits& limits) {
  lower(RLIMIT_CORE, 0);
  if (std::isfinite(limits.seconds)) lower(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.seconds)));
  if (limits.bytes < ProcessLimits{}.bytes) lower(RLIMIT_AS, address_space() + limits.bytes);
}

/// Silences messages of a library or of the system's allocator that gives up.
void silence_errors() {
#ifndef __SANITIZE_ADDRESS__  // whose findings are to be seen
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
#endif
}

// It ends with its parent, leaves Ctrl-C to it, and writes neither messages nor a core file.
[[noreturn]] void answer_and_exit(const std::function<std::string()>& compute, const ProcessLimits& limits, int pipe,
                                  pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_DFL);
  silence_errors();
  keep_to(limits);
  ::_exit(write_all(pipe, answer_of(compute)) ? 0 : 1);
}

[[noreturn]] void throw_system_error() {
  throw ComputationError("no process can be started: " + std::generic_category().message(errno));
}

ProcessLimits limits_of_reading(const std::filesystem::path& file) {
  constexpr double seconds = 20.0, bytes_per_second = 1e6;
  constexpr std::size_t bytes = std::size_t{1} << 30, inflation = 100;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown) return {.seconds = seconds, .bytes = bytes};
  return {.seconds = seconds + static_cast<double>(size) / bytes_per_second, .bytes = bytes + inflation * size};
}

}  // namespace

std::optional<std::string> computed_separately(const std::function<std::string()>& compute,
                                               const ProcessLimits& limits) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw_system_error();
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw_system_error();
  if (child == 0) {
    ::close(pipe[0]);
    answer_and_exit(compute, limits, pipe[1], parent);
  }
  ::close(pipe[1]);
  const std::string answer = read_all(pipe[0]);
  ::close(pipe[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty()) return std::nullopt;
  if (answer[0] == wrong_input) throw InputError(answer.substr(1));
  if (answer[0] == failure) throw ComputationError(answer.substr(1));
  return answer.substr(1);
}

std::string read_separately(const std::filesystem::path& file, std::string_view named,
                            const std::function<std::string()>& read) {
  const ProcessLimits limits = limits_of_reading(file);
  if (auto bytes = computed_separately(read, limits)) return std::move(*bytes);
  throw InputError(fmt::format("{}: it is damaged: reading it crashes, or takes more than {:.0f} s or {:.1f} GB", named,
                               limits.seconds, 1e-9 * static_cast<double>(limits.bytes)));
}

}  // namespace pfdm
