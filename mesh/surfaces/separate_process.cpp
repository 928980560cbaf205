#include "mesh/surfaces/separate_process.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <system_error>

#include "physics/error.h"

namespace pfdm {
namespace {

// What an answer begins with.
constexpr char result = 'r', wrong_input = 'i', failure = 'f';

std::string answer_of(const std::function<std::string()>& compute) {
  try {
    return result + compute();
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

// It ends with its parent, leaves Ctrl-C to it, and writes no core file.
[[noreturn]] void answer_and_exit(const std::function<std::string()>& compute, int pipe, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::_exit(write_all(pipe, answer_of(compute)) ? 0 : 1);
}

[[noreturn]] void throw_system_error() {
  throw ComputationError("no process can be started: " + std::generic_category().message(errno));
}

}  // namespace

std::optional<std::string> computed_separately(const std::function<std::string()>& compute) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw_system_error();
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw_system_error();
  if (child == 0) {
    ::close(pipe[0]);
    answer_and_exit(compute, pipe[1], parent);
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

}  // namespace pfdm
