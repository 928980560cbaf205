#include "tests/cases/own_slurm.h"

#include "cases/program/session/terminal/external_program.h"
#include "tests/cases/temporary_case.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// One that nothing listens to now.
int free_port() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool known = bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(descriptor);
  if (!known) throw std::runtime_error("there is no free port");
  return ntohs(address.sin_port);
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  const std::string whole = name;
  return whole.substr(0, whole.find('.'));
}

bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

std::string said_by(const std::vector<std::string>& words) { return run_external(words).out; }

void look_in_sbin_too() {
  constexpr std::string_view sbin = ":/usr/sbin";
  const char* path = getenv("PATH");
  const std::string now = path ? path : "";
  if (!now.ends_with(sbin)) setenv("PATH", (now + std::string(sbin)).c_str(), 1);
}

}  // namespace

std::optional<std::string> OwnSlurm::missing_program() {
  look_in_sbin_too();
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scancel"})
    if (!is_installed(program)) return program;
  return std::nullopt;
}

OwnSlurm::OwnSlurm() {
  std::string pattern = (fs::temp_directory_path() / "pfdm_slurm_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary directory");
  folder_ = pattern;
  fs::permissions(folder_, fs::perms(0755));  // munge wants its socket within everyone's reach
  configure();
  setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
  const auto in = [&](const char* option, const char* file) { return option + (folder_ / file).string(); };
  start({"munged", "--foreground", in("--socket=", "munge.socket"), in("--key-file=", "munge.key"),
         in("--pid-file=", "munge.pid"), in("--log-file=", "munge.log"), in("--seed-file=", "munge.seed")});
  const bool knows = comes_true([&] { return fs::exists(folder_ / "munge.socket"); });
  start({"slurmctld", "-D"});
  start({"slurmd", "-D"});
  if (knows && comes_true([] { return said_by({"sinfo", "--noheader", "--format=%T"}).find("idle") == 0; })) return;
  std::string words;
  for (const char* log : {"munge.log", "slurmctld.log", "slurmd.log", "daemons.log"})
    words += fmt::format("\n{}:\n{}", log, content_of(folder_ / log));
  stop();
  throw std::runtime_error("Slurm does not start" + words);
}

OwnSlurm::~OwnSlurm() { stop(); }

void OwnSlurm::stop() {
  for (; !daemons_.empty(); daemons_.pop_back()) {
    kill(daemons_.back(), SIGTERM);
    const auto ended = [&] { return waitpid(daemons_.back(), nullptr, WNOHANG) != 0; };
    if (comes_true(ended)) continue;
    kill(daemons_.back(), SIGKILL);
    waitpid(daemons_.back(), nullptr, 0);
  }
  unsetenv("SLURM_CONF");
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void OwnSlurm::configure() const {
  std::random_device random;
  std::string key(128, '\0');
  std::ranges::generate(key, [&] { return static_cast<char>(random()); });
  std::ofstream(folder_ / "munge.key", std::ios::binary) << key;
  fs::permissions(folder_ / "munge.key", fs::perms(0600));
  fs::create_directory(folder_ / "state");
  fs::create_directory(folder_ / "spool");
  std::ofstream(folder_ / "cgroup.conf") << "";
  std::ofstream(folder_ / "slurm.conf") << fmt::format(
      R"(ClusterName=pfdm
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000
ReturnToService=2
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
)",
      fmt::arg("host", host_name()), fmt::arg("user", getpwuid(geteuid())->pw_name),
      fmt::arg("folder", folder_.string()), fmt::arg("controller_port", free_port()),
      fmt::arg("node_port", free_port()));
}

/// Ends with this process, however that ends.
void OwnSlurm::start(const std::vector<std::string>& words) {
  std::vector<std::string> copy = words;
  std::vector<char*> arguments;
  arguments.reserve(copy.size() + 1);
  for (std::string& word : copy) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string log = (folder_ / "daemons.log").string();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("no process can be started");
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int descriptor = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(descriptor, STDOUT_FILENO);
    dup2(descriptor, STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  daemons_.push_back(pid);
}

bool OwnSlurm::wait_for_jobs() const {
  return comes_true([] { return said_by({"squeue", "--noheader"}).empty(); });
}

bool OwnSlurm::wait_for_running(int tasks) const {
  return comes_true([tasks] {
    const std::string states = said_by({"squeue", "--noheader", "--array", "--states=RUNNING", "--format=%T"});
    return std::ranges::count(states, '\n') == tasks;
  });
}

}  // namespace pfdm
