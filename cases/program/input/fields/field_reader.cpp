#include "cases/program/input/fields/field_reader.h"

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/input/config/field_keys.h"
#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/csv_columns.h"
#include "cases/program/input/fields/frame_list.h"
#include "mesh/files/field_file.h"
#include "mesh/search/scattered_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <unordered_map>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// SI values are factor * value + shift.
struct Units {
  double factor = 1.0, shift = 0.0;
};

Units read_units(const ConfigTable& table, const Dimension& due) {
  Units units;
  if (due.name != dimension::number.name || table.has("unit")) {
    const ConfigValue unit = table.at("unit");
    units.factor = unit.in_context([&] { return unit_in_si(unit.string(), due); });
    if (due.name != dimension::number.name)
      units.shift = unit.in_context([&] { return parse_quantity("0 " + unit.string(), due); });
  }
  const auto reference = table.find("reference");
  if (!reference && units.shift != 0.0)
    throw table.at("unit").error(fmt::format(
        "values in {} and the change of a temperature that is wanted differ by the reference: give it, as in "
        "reference = \"20 degC\"",
        table.string("unit")));
  if (reference) units.shift -= reference->quantity(due);
  return units;
}

struct Hash {
  std::size_t operator()(const std::array<double, 3>& x) const {
    std::size_t hash = 0;
    for (const double part : x) hash = hash * 0x9e3779b97f4a7c15ULL + std::hash<double>()(part);
    return hash;
  }
};

/// Values at known places, in one frame or in several.
struct Frames {
  std::vector<double> times;
  std::vector<std::shared_ptr<const KnownField>> fields;
  std::vector<std::vector<double>> values;

  void add(double time, FieldFile read) {
    times.push_back(time);
    fields.push_back(std::make_shared<const KnownField>(std::move(read.field)));
    values.push_back(std::move(read.values));
  }
};

double sum_of(const Interpolation& there, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < there.known.size(); ++i) sum += there.weight[i] * values[there.known[i]];
  return sum;
}

}  // namespace

struct FieldInFile::Content {
  ConfigValue value;
  ConfigTable table;
  Units units;
  std::string text;
  fs::path path;
  std::vector<ListedFrame> list;  // of a series
  double duration = 0.0, time_unit = 1.0, scale = 1.0;
  std::optional<double> tolerance;
  bool nearest = false;
  std::function<Frames()> read;

  std::once_flag once;
  std::optional<Frames> frames;
  std::shared_mutex guard;
  std::unordered_map<std::array<double, 3>, std::vector<double>, Hash> known;

  Content(const ConfigValue& of, const Dimension& due);
  void prepare_vtk();
  void prepare_csv(const Dimension& due);
  const std::vector<double>& at(const Vector& x);
  std::vector<double> looked_up(const Vector& x) const;
  InputError outside(const Vector& x, const KnownField& field, double distance, double allowed) const;
  double in_time(const std::vector<double>& values, double t) const;
};

FieldInFile::Content::Content(const ConfigValue& of, const Dimension& due)
    : value(of), table(of.table().with_keys(field_keys())) {
  units = read_units(table, due);
  nearest = table.choice("between", "linear") == "nearest";
  if (table.has("tolerance")) tolerance = table.quantity("tolerance");
  if (table.has("csv") && table.has("file")) throw value.error("a field is in a file or in a csv, not in both");
  table.has("csv") ? prepare_csv(due) : prepare_vtk();
  text +=
      fmt::format("{} * {} + {}, {} {}", path.string(), units.factor, units.shift, nearest, tolerance.value_or(-1.0));
}

void FieldInFile::Content::prepare_vtk() {
  const fs::path directory = fs::path(value.file()).parent_path();
  path = read_data_file(table.at("file"), directory);
  table.at("length_unit");
  scale = read_unit(table, "length_unit", dimension::length);
  const std::string array = table.string("array");
  const int component = static_cast<int>(table.integer("component", 0)) - 1;
  text = fmt::format("{}[{}] in {} m of ", array, component, scale);
  if (path.extension() == ".pvd") {
    duration = table.quantity("duration");
    time_unit = read_unit(table, "time_unit", dimension::time);
    list = table.at("file").in_context([&] { return read_frame_list(path); });
  } else {
    list = {{0.0, path}};
  }
  read = [this, array, component] {
    Frames found;
    for (const ListedFrame& frame : list)
      found.add(time_unit * frame.time, read_field_file(frame.file, array, component, scale));
    return found;
  };
}

void FieldInFile::Content::prepare_csv(const Dimension& due) {
  const fs::path directory = fs::path(value.file()).parent_path();
  const CsvTable file = read_csv_of(table, directory);
  path = directory / table.string("csv");
  table.at("length_unit");
  std::array<bool, 3> varies{};
  std::array<std::vector<double>, 4> columns;
  columns[3] = read_column(table, file, "column", "unit", due);
  units.factor = 1.0;
  std::vector<std::vector<double>*> used{&columns[3]};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string axis(1, "xyz"[a]);
    varies[a] = table.has(axis);
    if (!varies[a]) continue;
    columns[a] = read_column(table, file, axis, "length_unit", dimension::length);
    used.push_back(&columns[a]);
  }
  if (used.size() == 1) throw value.error("name the columns of the coordinates x, y, z on which the field depends");
  leave_out_gaps(table, used);
  for (std::size_t a = 0; a < 3; ++a)
    if (varies[a]) text += fmt::format("{} ", "xyz"[a]);
  for (const std::vector<double>* column : used)
    for (const double entry : *column) text += fmt::format("{} ", entry);
  std::vector<Vector> points(columns[3].size(), Vector::Zero());
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < columns[a].size(); ++i) points[i][a] = columns[a][i];
  read = [points, varies, values = columns[3]] {
    Frames found;
    found.add(0.0, {.field = scattered_field(points, varies), .values = values});
    return found;
  };
}

InputError FieldInFile::Content::outside(const Vector& x, const KnownField& field, double distance,
                                         double allowed) const {
  const auto shown = [&](const Vector& place) {
    std::string words;
    for (Eigen::Index a = 0; a < 3; ++a)
      words += (a ? ", " : "") + (field.varies[a] ? fmt::format("{:.6g}", place[a]) : "any");
    return "(" + words + ")";
  };
  const Box& box = field.places.around();
  return value.error(
      fmt::format("({:.6g}, {:.6g}, {:.6g}) m is {:.3g} m outside the field, which reaches from {} to {} m; allowed is "
                  "a tolerance of {:.3g} m. Is length_unit right? tolerance = \"1 mm\" takes the nearest value",
                  x[0], x[1], x[2], distance, shown(box.low), shown(box.high), allowed));
}

std::vector<double> FieldInFile::Content::looked_up(const Vector& x) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < frames->fields.size(); ++i) {
    const KnownField& field = *frames->fields[i];
    const Interpolation there = field.at(x, nearest);
    Vector extent = field.places.around().high - field.places.around().low;
    for (Eigen::Index a = 0; a < 3; ++a)
      if (!field.varies[a]) extent[a] = 0.0;
    const double allowed = tolerance.value_or(0.01 * extent.norm());
    if (there.outside > allowed) throw outside(x, field, there.outside, allowed);
    const double here = units.factor * sum_of(there, frames->values[i]) + units.shift;
    if (!std::isfinite(here))
      throw value.error(fmt::format("the field is {} at ({:.6g}, {:.6g}, {:.6g}) m", here, x[0], x[1], x[2]));
    values.push_back(here);
  }
  return values;
}

const std::vector<double>& FieldInFile::Content::at(const Vector& x) {
  std::call_once(once, [&] { frames = value.in_context([&] { return read(); }); });
  const std::array<double, 3> place{x[0], x[1], x[2]};
  {
    const std::shared_lock lock(guard);
    if (const auto found = known.find(place); found != known.end()) return found->second;
  }
  std::vector<double> values = looked_up(x);
  const std::unique_lock lock(guard);
  return known.try_emplace(place, std::move(values)).first->second;  // stays where it is
}

// Linear between frames, and that of the first one before it.
double FieldInFile::Content::in_time(const std::vector<double>& values, double t) const {
  const std::vector<double>& times = frames->times;
  const double time = t * duration;
  if (time <= times.front()) return values.front();
  constexpr double rounding = 1e-9;
  if (time > times.back() + rounding * std::abs(times.back()))
    throw value.error(fmt::format("its last frame is at {:.6g} s, and the load parameter {:.6g} is the time {:.6g} s",
                                  times.back(), t, time));
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
  if (after == times.size()) return values.back();
  const double share = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return (1.0 - share) * values[after - 1] + share * values[after];
}

bool is_field(const ConfigValue& value) {
  return value.is_table() && (value.table().has("file") || value.table().has("csv"));
}

FieldInFile::FieldInFile(const ConfigValue& value, const Dimension& due)
    : content_(std::make_shared<Content>(value, due)) {}

bool FieldInFile::is_series() const { return content_->duration > 0.0; }

double FieldInFile::operator()(const Vector& x, double t) const {
  const std::vector<double>& values = content_->at(x);
  return is_series() ? content_->in_time(values, t) : values.front();
}

const std::string& FieldInFile::text() const { return content_->text; }

std::vector<fs::path> field_files(const CaseFile& file) {
  std::vector<fs::path> files;
  for_each_value(parse_toml(file.text, "case.toml"), [&](const std::string&, const TomlValue& value) {
    const auto* table = std::get_if<TomlTable>(&value.value);
    if (table == nullptr) return;
    const auto text = [&](std::string_view key) {
      const auto found = std::ranges::find(*table, key, &TomlEntry::key);
      const auto* name = found == table->end() ? nullptr : std::get_if<std::string>(&found->value.value);
      return name ? std::optional(*name) : std::nullopt;
    };
    const auto has = [&](std::string_view key) { return std::ranges::count(*table, key, &TomlEntry::key) > 0; };
    const bool scattered = has("column") && (has("x") || has("y") || has("z"));
    if (const auto csv = text("csv"); csv && scattered) files.push_back(file.directory / *csv);
    const auto named = text("file");
    if (!named || !has("array")) return;
    files.push_back(file.directory / *named);
    if (files.back().extension() != ".pvd") return;
    for (const ListedFrame& frame : read_frame_list(files.back())) files.push_back(frame.file);
  });
  return files;
}

}  // namespace pfdm
