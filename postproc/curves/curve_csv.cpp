#include "postproc/curves/curve_csv.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pfdm {
namespace {

constexpr std::span<const EnergyEntry> energies{energy_entries};
constexpr auto first_energies = energies.first(3), later_energies = energies.subspan(3);
constexpr std::size_t n_before = 6, n_between = 3;  // columns that are no energies
constexpr std::size_t n_columns = n_before + n_between + energies.size();

// Shortest digits that give the same number back.
std::string to_line(const CurveRow& r) {
  std::string line =
      fmt::format("{},{},{},{},{},{}", r.step, r.load, r.displacement, r.force.x(), r.force.y(), r.force.z());
  for (const EnergyEntry& entry : first_energies) line += fmt::format(",{}", r.energy.*entry.value);
  line += fmt::format(",{},{},{}", r.max_damage, r.damaged_volume, r.staggered_iterations);
  for (const EnergyEntry& entry : later_energies) line += fmt::format(",{}", r.energy.*entry.value);
  return line + "\n";
}

std::optional<std::array<std::string_view, n_columns>> split(std::string_view line) {
  std::array<std::string_view, n_columns> columns;
  for (std::size_t i = 0; i < n_columns; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == n_columns)) return std::nullopt;
    columns[i] = line.substr(0, comma);
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  return columns;
}

std::optional<CurveRow> parse_row(std::string_view line) {
  constexpr std::size_t between = n_before + first_energies.size(), later = between + n_between;
  const auto columns = split(line);
  if (!columns) return std::nullopt;
  const auto step = parse_int(columns->front());
  const auto iterations = parse_int((*columns)[later - 1]);
  std::array<double, n_columns> v{};
  for (std::size_t i = 1; i < n_columns; ++i) {
    const auto number = parse_double((*columns)[i]);
    if (!number) return std::nullopt;
    v[i] = *number;
  }
  if (!step || !iterations) return std::nullopt;
  CurveRow row{.step = *step,
               .load = v[1],
               .displacement = v[2],
               .force = Vector(v[3], v[4], v[5]),
               .energy = {},
               .max_damage = v[between],
               .damaged_volume = v[between + 1],
               .staggered_iterations = *iterations};
  for (std::size_t i = 0; i < first_energies.size(); ++i) row.energy.*first_energies[i].value = v[n_before + i];
  for (std::size_t i = 0; i < later_energies.size(); ++i) row.energy.*later_energies[i].value = v[later + i];
  return row;
}

}  // namespace

std::string curve_header() {
  std::string header = "step,load,displacement_m,force_x_N,force_y_N,force_z_N";
  for (const EnergyEntry& entry : first_energies) header += fmt::format(",{}_J", entry.column);
  header += ",max_damage,damaged_volume_m3,staggered_iterations";
  for (const EnergyEntry& entry : later_energies) header += fmt::format(",{}_J", entry.column);
  return header;
}

CurveRow curve_row(const StepReport& report, Index patch, int component) {
  CurveRow row;
  row.step = report.step;
  row.load = report.load;
  row.displacement = report.patch_displacement[as_size(patch)][component];
  row.force = report.reaction[as_size(patch)];
  row.energy = report.energy;
  row.max_damage = report.max_damage;
  row.damaged_volume = report.damaged_volume;
  row.staggered_iterations = report.staggered_iterations;
  return row;
}

std::vector<CurveRow> read_curve(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::string_view rest = content;
  std::vector<CurveRow> rows;
  // Only lines with their line break count: of a torn one even the last number may lack digits.
  for (std::size_t line_number = 1, end; (end = rest.find('\n')) != std::string_view::npos; ++line_number) {
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (line_number == 1) {
      if (line != curve_header())
        throw InputError(
            fmt::format("{}, line 1: found \"{}\" instead of \"{}\"", path.string(), line, curve_header()));
      continue;
    }
    const auto row = parse_row(line);
    if (!row)
      throw InputError(
          fmt::format("{}, line {}: \"{}\" is not a row of {} numbers", path.string(), line_number, line, n_columns));
    rows.push_back(*row);
  }
  return rows;
}

CurveFile::CurveFile(std::filesystem::path path) : path_(std::move(path)) { write(); }

CurveFile::CurveFile(std::filesystem::path path, Index last_step) : path_(std::move(path)) {
  if (std::filesystem::exists(path_)) rows_ = read_curve(path_);
  std::erase_if(rows_, [=](const CurveRow& row) { return row.step > last_step; });
  write();
}

void CurveFile::write() const {
  std::string content = curve_header() + "\n";
  for (const CurveRow& row : rows_) content += to_line(row);
  write_file(path_, content);
}

}  // namespace pfdm
