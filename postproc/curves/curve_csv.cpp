#include "postproc/curves/curve_csv.h"

#include "postproc/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <string>

namespace pfdm {
namespace {

constexpr std::span<const EnergyEntry> energies{energy_entries};
constexpr auto first_energies = energies.first(3), later_energies = energies.subspan(3);
constexpr std::size_t n_before = 6, n_between = 3;  // columns that are no energies

const std::vector<std::string>& column_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"step", "load", "displacement_m", "force_x_N", "force_y_N", "force_z_N"};
    for (const EnergyEntry& entry : first_energies) all.push_back(fmt::format("{}_J", entry.column));
    all.insert(all.end(), {"max_damage", "damaged_volume_m3", "staggered_iterations"});
    for (const EnergyEntry& entry : later_energies) all.push_back(fmt::format("{}_J", entry.column));
    return all;
  }();
  return names;
}

CurveRow row_of(const std::vector<double>& v) {
  constexpr std::size_t between = n_before + first_energies.size(), later = between + n_between;
  CurveRow row{.step = static_cast<Index>(v[0]),
               .load = v[1],
               .displacement = v[2],
               .force = Vector(v[3], v[4], v[5]),
               .energy = {},
               .max_damage = v[between],
               .damaged_volume = v[between + 1],
               .staggered_iterations = static_cast<Index>(v[later - 1])};
  for (std::size_t i = 0; i < first_energies.size(); ++i) row.energy.*first_energies[i].value = v[n_before + i];
  for (std::size_t i = 0; i < later_energies.size(); ++i) row.energy.*later_energies[i].value = v[later + i];
  return row;
}

std::string lines_of(std::span<const CurveRow> rows) {
  std::string lines;
  for (const CurveRow& row : rows) lines += curve_line(row);
  return lines;
}

std::vector<CurveRow> rows_up_to(Index last_step, const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  std::vector<CurveRow> rows = read_curve(path);
  std::erase_if(rows, [=](const CurveRow& row) { return row.step > last_step; });
  return rows;
}

}  // namespace

std::string curve_header() { return fmt::format("{}", fmt::join(column_names(), ",")); }

std::string curve_line(const CurveRow& r) {
  std::string line =
      fmt::format("{},{},{},{},{},{}", r.step, r.load, r.displacement, r.force.x(), r.force.y(), r.force.z());
  for (const EnergyEntry& entry : first_energies) line += fmt::format(",{}", r.energy.*entry.value);
  line += fmt::format(",{},{},{}", r.max_damage, r.damaged_volume, r.staggered_iterations);
  for (const EnergyEntry& entry : later_energies) line += fmt::format(",{}", r.energy.*entry.value);
  return line + "\n";
}

CurveRow curve_row(const StepReport& report, Index patch, int component) {
  CurveRow row = curve_row(report);
  row.displacement = report.patch_displacement[patch][component];
  row.force = report.reaction[patch];
  return row;
}

CurveRow curve_row(const StepReport& report) {
  CurveRow row;
  row.step = report.step;
  row.load = report.load;
  row.energy = report.energy;
  row.max_damage = report.max_damage;
  row.damaged_volume = report.damaged_volume;
  row.staggered_iterations = report.staggered_iterations;
  return row;
}

std::vector<CurveRow> read_curve(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path, {.whole_numbers = {"step", "staggered_iterations"},
                                         .own_names = column_names(),
                                         .n_newer_names = n_newer_energies});
  std::vector<CurveRow> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    std::vector<double> values;
    for (const std::vector<double>& column : table.columns) values.push_back(column[i]);
    rows.push_back(row_of(values));
  }
  return rows;
}

CurveFile::CurveFile(std::filesystem::path path, std::vector<CurveRow> rows)
    : rows_(std::move(rows)), file_(std::move(path), text()), n_written_(rows_.size()) {}

CurveFile::CurveFile(std::filesystem::path path) : CurveFile(std::move(path), std::vector<CurveRow>()) {}

CurveFile::CurveFile(std::filesystem::path path, Index last_step) : CurveFile(path, rows_up_to(last_step, path)) {}

std::string CurveFile::text() const { return curve_header() + "\n" + lines_of(rows_); }

void CurveFile::write() {
  file_.append(lines_of(std::span(rows_).subspan(n_written_)), [this] { return text(); });
  n_written_ = rows_.size();
}

}  // namespace pfdm
