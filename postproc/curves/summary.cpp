#include "postproc/curves/summary.h"

#include "postproc/curves/instruction_set.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

double balance_error(const CurveRow& start, const CurveRow& row) {
  if (!(supplied(row.energy) > 0.0)) return Headlines::none;
  return std::abs(left_over(start.energy, row.energy)) / supplied(row.energy);
}

double initial_stiffness(std::span<const CurveRow> rows, int component) {
  const double start = rows.front().displacement;
  auto to = std::ranges::find_if(rows, [&](const CurveRow& row) { return row.displacement != start; });
  if (to == rows.end()) return Headlines::none;
  const bool begins_otherwise = to != rows.begin() + 1;  // the step may have a part of that
  if (begins_otherwise && to + 1 != rows.end() && (to + 1)->displacement != to->displacement) ++to;
  const auto from = to - 1;
  return (to->force[component] - from->force[component]) / (to->displacement - from->displacement);
}

double largest_balance_error(std::span<const CurveRow> rows) {
  double largest = Headlines::none;
  for (const CurveRow& row : rows) largest = std::fmax(largest, balance_error(rows.front(), row));
  return largest;
}

void find_release(std::span<const CurveRow> rows, Headlines& figures) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double released =
        left_over(rows.front().energy, rows[i].energy) - left_over(rows.front().energy, rows[i - 1].energy);
    if (figures.released_energy >= released) continue;  // none is no number, which is never so
    figures.released_energy = released;
    figures.displacement_at_release = rows[i].displacement;
  }
}

// Headlines::peak_force_at_most.
double at_most_in_next_step(std::span<const CurveRow> rows, std::ptrdiff_t peak, int component) {
  constexpr double lost = 0.9;
  const auto force = [&](std::ptrdiff_t k) { return rows[static_cast<std::size_t>(k)].force[component]; };
  const auto load = [&](std::ptrdiff_t k) { return rows[static_cast<std::size_t>(k)].load; };
  const double most = force(peak);
  if (peak < 1 || peak + 1 >= std::ssize(rows) || std::abs(force(peak + 1)) >= lost * std::abs(most)) return most;
  const double rise = most - force(peak - 1), before = load(peak) - load(peak - 1), next = load(peak + 1) - load(peak);
  return before > 0.0 && next > 0.0 && rise * most > 0.0 ? most + rise / before * next : most;
}

Json to_json(const Headlines& f) {
  Json json = {{"peak_force_N", f.peak_force},
               {"displacement_at_peak_m", f.displacement_at_peak},
               {"load_at_peak", f.load_at_peak},
               {"peak_force_at_most_N", f.peak_force_at_most},
               {"initial_stiffness_N_per_m", f.initial_stiffness},
               {"final_force_N", f.final_force},
               {"final_displacement_m", f.final_displacement},
               {"final_load", f.final_load}};
  for (const EnergyEntry& entry : energy_entries) json[fmt::format("{}_J", entry.figure)] = f.energy.*entry.value;
  json.update(Json{{"energy_balance_error", f.energy_balance_error},
                   {"max_energy_balance_error", f.max_energy_balance_error},
                   {"released_energy_J", f.released_energy},
                   {"displacement_at_release_m", f.displacement_at_release},
                   {"max_damage", f.max_damage},
                   {"damaged_volume_m3", f.damaged_volume}});
  return json;
}

Json to_json(const RunSummary& s) {
  Json json = {{"case", s.case_name},
               {"status", s.status},
               {"version", s.version},
               {"instruction_set", instruction_set()},
               {"processor", processor_name()},
               {"case_hash", s.case_hash},
               {"threads", s.threads},
               {"cells", s.cells},
               {"unknowns", s.unknowns},
               {"steps", s.steps},
               {"staggered_iterations", s.staggered_iterations},
               {"krylov_iterations", s.krylov_iterations},
               {"wall_seconds", s.wall_seconds},
               {"cpu_seconds", s.cpu_seconds},
               {"wall_seconds_by_stage", s.wall_seconds_by_stage},
               {"cpu_seconds_by_stage", s.cpu_seconds_by_stage},
               {"peak_memory_bytes", std::llround(s.peak_memory)}};
  if (s.figures) json.update(to_json(*s.figures));
  for (const auto& [name, value] : s.other_figures) json[name] = value;
  for (const auto& [name, count] : s.other_counts) json[name] = count;
  for (const auto& [name, text] : s.other_texts) json[name] = text;
  return json;
}

rusage usage() {
  rusage now{};
  getrusage(RUSAGE_SELF, &now);
  return now;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Headlines headlines(std::span<const CurveRow> rows, int component) {
  Headlines figures;
  if (rows.empty()) return figures;
  const auto force = [component](const CurveRow& row) { return row.force[component]; };
  const auto at_peak = std::ranges::max_element(rows, {}, [&](const CurveRow& row) { return std::abs(force(row)); });
  const CurveRow& peak = *at_peak;
  figures.peak_force = force(peak);
  figures.peak_force_at_most = at_most_in_next_step(rows, at_peak - rows.begin(), component);
  figures.displacement_at_peak = peak.displacement;
  figures.load_at_peak = peak.load;
  figures.initial_stiffness = initial_stiffness(rows, component);
  const CurveRow& last = rows.back();
  figures.final_force = force(last);
  figures.final_displacement = last.displacement;
  figures.final_load = last.load;
  figures.energy = last.energy;
  figures.max_damage = last.max_damage;
  figures.damaged_volume = last.damaged_volume;
  figures.energy_balance_error = balance_error(rows.front(), last);
  figures.max_energy_balance_error = largest_balance_error(rows);
  find_release(rows, figures);
  return figures;
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary) {
  write_file(path, json_text(to_json(summary)));
}

double RunSummary::other_figure(const std::string& name) const {
  const auto found = other_figures.find(name);
  return found != other_figures.end() ? found->second : Headlines::none;
}

double ReadSummary::number(std::string_view name) const {
  const auto found = std::ranges::find(numbers, name, &std::pair<std::string, double>::first);
  return found != numbers.end() ? found->second : Headlines::none;
}

std::optional<ReadSummary> read_summary(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return read_json(path, "summary of a run", [](const Json& json) {
    ReadSummary summary{.status = json.at("status"),
                        .case_hash = json.at("case_hash"),
                        .processor = json.value("processor", ""),
                        .numbers = {}};
    for (const auto& [name, value] : json.items())
      if (value.is_number() || value.is_null()) summary.numbers.emplace_back(name, number_of(value));
    return summary;
  });
}

RunSummary read_run_summary(const std::filesystem::path& path) {
  return read_json(path, "summary of a run", [](const Json& json) {
    RunSummary s;
    s.case_name = json.at("case");
    s.status = json.at("status");
    s.version = json.at("version");
    s.case_hash = json.at("case_hash");
    s.threads = whole_number<int>(json.at("threads"));
    s.cells = whole_number<Index>(json.at("cells"));
    s.unknowns = whole_number<Index>(json.at("unknowns"));
    s.steps = whole_number<Index>(json.at("steps"));
    s.staggered_iterations = whole_number<Index>(json.at("staggered_iterations"));
    s.krylov_iterations = whole_number<Index>(json.at("krylov_iterations"));
    s.wall_seconds = json.at("wall_seconds");
    s.cpu_seconds = json.at("cpu_seconds");
    s.wall_seconds_by_stage = json.at("wall_seconds_by_stage");
    s.cpu_seconds_by_stage = json.at("cpu_seconds_by_stage");
    s.peak_memory = json.at("peak_memory_bytes");
    const Json known = to_json(s);
    for (const auto& [name, value] : json.items()) {
      if (known.contains(name)) continue;
      if (value.is_number_integer())
        s.other_counts[name] = value;
      else if (value.is_number() || value.is_null())
        s.other_figures[name] = number_of(value);
      else if (value.is_string())
        s.other_texts[name] = value;
    }
    return s;
  });
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const std::size_t at = line.find(": "); at != std::string::npos) return line.substr(at + 2);
  return {};
}

// getrusage would count the program that has started this one as well.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));  // in KiB
  return 1024.0 * static_cast<double>(usage().ru_maxrss);
}

double cpu_seconds() {
  const rusage now = usage();
  return seconds(now.ru_utime) + seconds(now.ru_stime);
}

}  // namespace pfdm
