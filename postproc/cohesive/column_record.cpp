#include "postproc/cohesive/column_record.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr const char* places_file = "places.csv";
constexpr const char* cohesive_mark = "faces of a cohesive interface";
constexpr std::string_view axis_names[] = {"n", "1", "2"};

// The one list of what a row holds, for both directions: visit(name, number) for each.
template <class Sample, class Visit>
void visit_sample(Sample& sample, const Visit& visit) {
  for (Index k = 0; k < 3; ++k) visit(fmt::format("traction_{}_Pa", axis_names[k]), sample.traction[k]);
  for (Index k = 0; k < 3; ++k) visit(fmt::format("separation_{}_m", axis_names[k]), sample.separation[k]);
  for (Index k = 0; k < 3; ++k) visit(fmt::format("bulk_separation_{}_m", axis_names[k]), sample.bulk[k]);
  visit("surface_energy_J_per_m2", sample.surface_energy);
  visit("largest_damage", sample.largest_damage);
}

template <class APlace, class Visit>
void visit_place(APlace& place, const Visit& visit) {
  constexpr const char* axes[] = {"x", "y", "z"};
  for (Index k = 0; k < 3; ++k) visit(fmt::format("{}_m", axes[k]), place.point[k]);
  for (Index k = 0; k < 3; ++k) visit(fmt::format("normal_{}", axes[k]), place.normal[k]);
  visit("polar_angle_rad", place.polar_angle);
  visit("area_m2", place.area);
  visit("length_m", place.length);
}

template <class Row, class VisitRow>
CsvTable table_of(const std::vector<Row>& rows, const VisitRow& visit_row) {
  CsvTable table;
  for (const Row& row : rows) {
    std::size_t i = 0;
    visit_row(row, [&](const std::string& name, double value) {
      if (&row == &rows.front()) table.add(name, {});
      table.columns[i++].push_back(value);
    });
  }
  return table;
}

template <class Row, class VisitRow>
std::vector<Row> rows_of(const CsvTable& table, const VisitRow& visit_row) {
  std::vector<Row> rows(table.n_rows());
  for (std::size_t r = 0; r < rows.size(); ++r)
    visit_row(rows[r], [&](const std::string& name, double& value) { value = table.column(name)[r]; });
  return rows;
}

constexpr auto visit_samples = [](auto& sample, const auto& visit) { visit_sample(sample, visit); };
constexpr auto visit_places = [](auto& place, const auto& visit) { visit_place(place, visit); };

fs::path step_file(Index step) { return fmt::format("step_{:06}.csv", step); }

/// The step that a file is of; none for other files.
std::optional<Index> step_of(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with("step_") || file.extension() != ".csv") return std::nullopt;
  return parse_int(name.substr(5, name.size() - 9));
}

void remove_steps_beyond(const fs::path& folder, Index last) {
  std::error_code ignored;  // what cannot be removed will not be writable either, and that is said then
  std::vector<fs::path> beyond;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (const auto step = step_of(entry.path()); step && *step > last) beyond.push_back(entry.path());
  for (const fs::path& file : beyond) fs::remove(file, ignored);
}

ColumnRecord read_record(const fs::path& folder, std::optional<Index> last_step) {
  const CsvTable places = read_csv(folder / places_file);
  ColumnRecord record{.name = folder.filename().string(), .places = rows_of<Place>(places, visit_places), .steps = {}};
  if (std::ranges::count(places.comments, name_of(SurfaceKind::plane)) > 0) record.kind = SurfaceKind::plane;
  record.is_cohesive = std::ranges::count(places.comments, cohesive_mark) > 0;
  std::map<Index, fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto step = step_of(entry.path()); step && *step <= last_step.value_or(*step))
      files[*step] = entry.path();
  for (const auto& [step, file] : files) {
    if (static_cast<std::size_t>(step) != record.steps.size())
      throw InputError(fmt::format("{}: step {} is missing; run the case again", folder.string(), record.steps.size()));
    record.steps.push_back(rows_of<ColumnSample>(read_csv(file), visit_samples));
    if (record.steps.back().size() != record.places.size())
      throw InputError(fmt::format("{}: found {} rows for {} places", file.string(), record.steps.back().size(),
                                   record.places.size()));
  }
  if (record.steps.empty()) throw InputError(fmt::format("{}: it contains no load step", folder.string()));
  return record;
}

}  // namespace

double ColumnRecord::area() const {
  double sum = 0.0;
  for (const Place& place : places) sum += place.area;
  return sum;
}

void remove_columns(const fs::path& folder) {
  remove_steps_beyond(folder, -1);
  std::error_code ignored;
  std::vector<fs::path> sets;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) sets.push_back(entry.path());
  for (const fs::path& set : sets) {
    if (!fs::remove(set / places_file, ignored)) continue;
    remove_leftovers(set);
    fs::remove(set, ignored);  // unless there is something else in it
  }
}

ColumnFiles::ColumnFiles(fs::path folder, const std::vector<ColumnSet>& sets, const Vector& axis,
                         std::optional<Index> last_step)
    : folder_(std::move(folder)), sets_(sets) {
  remove_steps_beyond(folder_, last_step.value_or(-1));
  for (const ColumnSet& set : sets_) {
    remove_leftovers(folder_ / set.name);
    std::vector<Place> places;
    for (const Column& c : set.columns)
      places.push_back({c.point, c.normal, polar_angle(c.normal, axis), c.area, c.length});
    CsvTable table = table_of(places, visit_places);
    table.comments = {std::string(name_of(set.kind))};
    if (set.is_cohesive) table.comments.emplace_back(cohesive_mark);
    make_folder(folder_ / set.name);
    write_csv(folder_ / set.name / places_file, table);
  }
}

void ColumnFiles::append(Index step, const Mesh& mesh, const FractureModel& model, const OutputFields& output) const {
  for (const ColumnSet& set : sets_)
    write_csv(folder_ / set.name / step_file(step), table_of(sample_columns(mesh, model, output, set), visit_samples));
}

std::vector<ColumnRecord> read_columns(const fs::path& folder, std::optional<Index> last_step) {
  std::vector<fs::path> sets;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (fs::exists(entry.path() / places_file)) sets.push_back(entry.path());
  std::sort(sets.begin(), sets.end());
  std::vector<ColumnRecord> records;
  records.reserve(sets.size());
  for (const fs::path& set : sets) records.push_back(read_record(set, last_step));
  return records;
}

}  // namespace pfdm
