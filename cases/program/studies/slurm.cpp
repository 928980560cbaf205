#include "cases/program/studies/slurm.h"

#include "cases/program/session/external_program.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>

namespace pfdm {
namespace {

constexpr Range cpus_range{1.0, 4096.0, false, "between 1 and 4096"};
constexpr Range tasks_range{1.0, 1e6, false, "between 1 and 1000000"};

std::string read_memory(const ConfigValue& value) {
  static const std::regex amount(R"((\d{1,9}) ?([MGT])B)");
  std::smatch match;
  const std::string text = value.string();
  if (!std::regex_match(text, match, amount))
    throw value.error(fmt::format(
        "\"{}\" is not an amount of memory; expected a whole number of MB, GB or TB, as in \"4 GB\"", text));
  return fmt::format("{}{}", match[1].str(), match[2].str());
}

/// It becomes a line of the script.
std::string read_partition(const ConfigValue& value) {
  static const std::regex names("[A-Za-z0-9_.,:@+-]*");
  const std::string text = value.string();
  if (!std::regex_match(text, names))
    throw value.error(
        "this is not a partition, or a list of them, as in \"short,long\": letters, digits and _ . : @ + - only");
  return text;
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
  table.with_keys({"partition", "time", "cpus_per_task", "memory", "at_once", "largest_array", "lines"});
  SlurmSettings settings;
  if (table.has("partition")) settings.partition = read_partition(table.at("partition"));
  if (table.has("time")) settings.time = table.quantity("time", dimension::time, range::positive);
  settings.cpus_per_task = static_cast<int>(table.integer("cpus_per_task", cpus_range, settings.cpus_per_task));
  if (table.has("memory")) settings.memory = read_memory(table.at("memory"));
  settings.at_once = static_cast<int>(table.integer("at_once", tasks_range, settings.at_once));
  settings.largest_array = static_cast<int>(table.integer("largest_array", tasks_range, settings.largest_array));
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
  ask("job-name=" + std::regex_replace(name, std::regex("[^A-Za-z0-9_.-]"), "_"));
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
  static const std::regex columns(R"(([^|]*)\|([^|]*)\|([^|]*)\|(.*))");
  std::smatch match;
  for (std::string_view rest = end.out; !rest.empty();) {
    const std::string line(take_line(rest));
    if (!std::regex_match(line, match, columns) || match[4].str() != folder.string()) continue;
    if (std::ranges::count(active.jobs, match[1].str()) == 0) active.jobs.push_back(match[1].str());
    const bool waits = match[2].str() == "PENDING";
    ++(waits ? active.queued : active.running);
    if (waits) active.reason = match[3].str();
  }
  return active;
}

std::string quoted(const std::string& word) {
  return fmt::format("'{}'", std::regex_replace(word, std::regex("'"), "'\\''"));
}

}  // namespace pfdm
