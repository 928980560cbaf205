#include "cases/program/studies/runs/slurm.h"

#include "cases/program/input/config/key_member.h"
#include "cases/program/session/terminal/external_program.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace pfdm {
namespace {

constexpr std::string_view of_words = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-";

/// "4G" of "4 GB", as Slurm writes it.
std::string read_memory(const ConfigValue& value) {
  const std::string text = value.string();
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  std::string_view unit = std::string_view(text).substr(digits);
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  if (digits < 1 || digits > 9 || (unit != "MB" && unit != "GB" && unit != "TB"))
    throw value.error(fmt::format(
        "\"{}\" is not an amount of memory; expected a whole number of MB, GB or TB, as in \"4 GB\"", text));
  return fmt::format("{}{}", text.substr(0, digits), unit.front());
}

/// It becomes a line of the script.
std::string read_partition(const ConfigValue& value) {
  std::string text = value.string();
  if (text.find_first_not_of(std::string(of_words) + ",:@+") != std::string::npos)
    throw value.error(
        "this is not a partition, or a list of them, as in \"short,long\": letters, digits and _ . : @ + - only");
  return text;
}

std::string name_of_job(std::string name) {
  for (char& c : name)
    if (of_words.find(c) == std::string_view::npos) c = '_';
  return name;
}

/// The first three columns and the rest of a line with bars between them; none if it has fewer.
std::optional<std::array<std::string_view, 4>> columns_of(std::string_view line) {
  std::array<std::string_view, 4> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t bar = line.find('|');
    if (bar == std::string_view::npos) return std::nullopt;
    columns[i] = line.substr(0, bar);
    line.remove_prefix(bar + 1);
  }
  columns[3] = line;
  return columns;
}

std::vector<std::string> read_lines(const ConfigTable& table) {
  std::vector<std::string> lines = table.strings("lines");
  for (const std::string& line : lines)
    if (std::ranges::any_of(line, [](unsigned char c) { return std::iscntrl(c) != 0 && c != '\t'; }))
      throw table.at("lines").error("each line must be an entry of its own, without line breaks or control characters");
  return lines;
}

ComputationError objection(const std::string& command, const ProgramEnd& end) {
  return ComputationError(fmt::format("{} failed with status {}: {}", command, end.status, trimmed(end.err)));
}

}  // namespace

SlurmSettings read_slurm(const ConfigTable& table) {
  SlurmSettings settings;
  if (table.has("partition")) settings.partition = read_partition(table.at("partition"));
  read_stored(table, settings);
  if (table.has("memory")) settings.memory = read_memory(table.at("memory"));
  if (table.has("lines")) settings.lines = read_lines(table);
  return settings;
}

bool slurm_is_here() { return is_installed("sbatch") && is_installed("squeue"); }

void require_slurm() {
  if (!slurm_is_here())
    throw InputError(
        "--slurm: Slurm's commands sbatch and squeue are not on the PATH of this machine; without --slurm the runs are "
        "made here, side by side");
}

std::string array_script(const SlurmSettings& settings, const std::string& name, std::size_t n_tasks,
                         const std::string& commands) {
  std::string text = "#!/bin/bash\n";
  const auto ask = [&](const std::string& option) { text += fmt::format("#SBATCH --{}\n", option); };
  ask("job-name=" + name_of_job(name));
  ask(fmt::format("array=1-{}{}", n_tasks, settings.at_once > 0 ? fmt::format("%{}", settings.at_once) : ""));
  ask("output=task_%a.log");
  ask("ntasks=1");
  ask(fmt::format("cpus-per-task={}", settings.cpus_per_task));
  if (!settings.partition.empty()) ask("partition=" + settings.partition);
  if (settings.time) ask(fmt::format("time={:.0f}", std::ceil(*settings.time / 60.0)));  // [min]
  if (!settings.memory.empty()) ask("mem=" + settings.memory);
  // Slurm reads no option behind the first command.
  std::vector<std::string> lines = settings.lines;
  std::stable_partition(lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("#SBATCH"); });
  for (const std::string& line : lines) text += fmt::format("{}\n", line);
  return text + commands;
}

std::string submit(const std::filesystem::path& folder, const std::string& script) {
  const ProgramEnd end =
      run_external({"sbatch", "--parsable", "--chdir=" + folder.string(), (folder / script).string()});
  if (end.status != 0) throw objection("sbatch", end);
  const std::string_view number = trimmed(end.out);
  return std::string(number.substr(0, number.find(';')));  // the cluster's name may follow
}

ActiveTasks active_tasks(const std::filesystem::path& folder) {
  const ProgramEnd end = run_external({"squeue", "--me", "--noheader", "--array", "--format=%F|%T|%r|%Z"});
  if (end.status != 0) throw objection("squeue", end);
  ActiveTasks active;
  for (std::string_view rest = end.out; !rest.empty();) {
    const auto columns = columns_of(take_line(rest));
    if (!columns || (*columns)[3] != folder.string()) continue;
    const auto [job, state, reason, of_folder] = *columns;
    if (std::ranges::count(active.jobs, job) == 0) active.jobs.emplace_back(job);
    const bool waits = state == "PENDING";
    ++(waits ? active.queued : active.running);
    if (waits) active.reason = reason;
  }
  return active;
}

}  // namespace pfdm
