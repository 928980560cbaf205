#include "cases/program/studies/sweep/sweep_on_slurm.h"

#include "cases/program/session/terminal/external_program.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr const char* tasks_file = "tasks.txt";
constexpr const char* script_file = "job.sh";

/// As Slurm shows it.
fs::path whole_path(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

fs::path folder_of(const Session& session) { return whole_path(session.results) / "sweep"; }

fs::path log_of(const fs::path& folder, std::size_t task) { return folder / fmt::format("task_{}.log", task + 1); }

std::vector<std::string> last_tasks(const fs::path& folder) {
  std::vector<std::string> runs;
  if (!fs::exists(folder / tasks_file)) return runs;
  const std::string text = read_file(folder / tasks_file);
  for (std::string_view rest = text; !rest.empty();) runs.emplace_back(take_line(rest));
  return runs;
}

std::string described(const ActiveTasks& tasks) {
  return fmt::format("Slurm job {}: {} runs queued{}, {} running", fmt::join(tasks.jobs, ", "), tasks.queued,
                     tasks.reason.empty() ? "" : fmt::format(" ({})", tasks.reason), tasks.running);
}

std::string last_line(const std::string& text) {
  const std::string_view all = trimmed(text);
  return std::string(all.substr(all.find_last_of('\n') + 1));
}

/// Runs that a task was to make, and that are not there although it has ended.
void warn_of_broken_tasks(const fs::path& folder, std::span<const MissingRun> missing, Log& log) {
  const std::vector<std::string> tasks = last_tasks(folder);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const auto run = std::ranges::find(missing, tasks[i], &MissingRun::key);
    if (run == missing.end()) continue;
    const bool said = fs::exists(log_of(folder, i));
    log.warn(fmt::format(
        "the task of {} ended without a result{}", run->variant->shown,
        said ? fmt::format("; the last line of its output: {}", last_line(read_file(log_of(folder, i)))) : ""));
  }
}

std::string commands_of_task(const fs::path& directory, const fs::path& results) {
  return fmt::format(
      "run=$(sed -n \"${{SLURM_ARRAY_TASK_ID}}p\" {})\n"
      "exec {} sweep {} --output {} --prepared \"$run\" --threads \"$SLURM_CPUS_PER_TASK\"\n",
      tasks_file, quoted(fs::read_symlink("/proc/self/exe").string()), quoted(directory.string()),
      quoted(results.string()));
}

void prepare(const CaseFile& file, const SlurmSettings& settings, std::span<const MissingRun> runs,
             const Session& session) {
  const fs::path folder = folder_of(session);
  std::error_code ignored;
  fs::remove_all(folder, ignored);  // of tasks that have ended
  make_folder(folder);
  std::string tasks;
  for (const MissingRun& run : runs) {
    write_file(folder / (run.key + ".toml"), run.variant->file.text);
    tasks += run.key + "\n";
  }
  write_file(folder / tasks_file, tasks);
  write_file(folder / script_file,
             array_script(settings, "pfdm_" + case_name(file), runs.size(),
                          commands_of_task(whole_path(file.directory), whole_path(session.results))));
}

}  // namespace

void hand_to_slurm(const CaseFile& file, const SlurmSettings& settings, std::span<const MissingRun> missing,
                   Session& session) {
  const fs::path folder = folder_of(session);
  const ActiveTasks active = active_tasks(folder);
  if (active.any()) {
    session.log.say(fmt::format(
        "{}; {} runs are not complete. Nothing was submitted; the same command collects them when all are complete",
        described(active), missing.size()));
    return;
  }
  warn_of_broken_tasks(folder, missing, session.log);
  const auto now = missing.first(std::min(missing.size(), static_cast<std::size_t>(settings.largest_array)));
  prepare(file, settings, now, session);
  std::string job;
  try {
    job = submit(folder, script_file);
  } catch (const ComputationError&) {
    fs::remove(folder / tasks_file);  // nobody is at work on them
    throw;
  }
  const std::size_t left = missing.size() - now.size();
  session.log.say(fmt::format(
      "Slurm job {}: {} runs submitted{}; the same command shows their state and collects them when all are complete",
      job, now.size(), left == 0 ? "" : fmt::format(", {} left for the next job", left)));
}

void require_no_tasks_of(const Session& session) {
  const fs::path folder = folder_of(session);
  if (!fs::exists(folder / tasks_file) || !slurm_is_here()) return;
  if (const ActiveTasks active = active_tasks(folder); active.any())
    throw InputError(fmt::format("{}: {}; wait for them, or stop them with scancel {}", session.results.string(),
                                 described(active), fmt::join(active.jobs, " ")));
}

void make_prepared_run(const fs::path& directory, const std::string& run, Session& session) {
  const fs::path prepared = folder_of(session) / (run + ".toml");
  const std::string text = read_file(prepared);
  const CaseFile file{.directory = directory, .text = text, .config = Config(text, prepared.string())};
  CaseRuns(session.results / "runs", session).run_here({file, run}, run);
}

}  // namespace pfdm
