// The files of [[experiment.fields]]: frames, and where on the curve they were taken. A member of field_case.h.

#include "cases/program/fracture/case/field_case.h"
#include "cases/program/fracture/case/field_columns.h"
#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/csv_columns.h"
#include "cases/program/input/fields/csv_marks.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

namespace pfdm {
namespace {

/// Rows of a file that are one frame.
struct FrameRows {
  std::string name;
  double number = 0.0;
  const CsvTable* file = nullptr;
  std::vector<std::size_t> rows;
};

std::vector<double> numbers_of(const ConfigValue& column, const CsvTable& file) {
  const std::size_t found = find_column(column, file);
  column.in_context([&] { file.require_numbers(found); });
  return file.columns[found];
}

std::vector<CsvTable> read_files(const ConfigTable& table, const std::filesystem::path& directory) {
  const CsvOptions options{.is_foreign = true, .marks = read_csv_marks(table), .is_unit = is_unit};
  std::vector<CsvTable> files;
  for (const ConfigValue& name : table.at("files").list())
    files.push_back(name.in_context([&] { return read_csv(read_data_file(name, directory), options); }));
  return files;
}

std::vector<FrameRows> frames_of(const ConfigTable& table, const std::vector<CsvTable>& files) {
  std::vector<FrameRows> frames;
  const std::vector<ConfigValue> names = table.at("files").list();
  const auto column = table.find("frame");
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (!column) {
      FrameRows& frame =
          frames.emplace_back(FrameRows{.name = std::filesystem::path(names[k].string()).filename().string(),
                                        .number = static_cast<double>(k + 1),
                                        .file = &files[k],
                                        .rows = {}});
      frame.rows.resize(files[k].n_rows());
      std::iota(frame.rows.begin(), frame.rows.end(), 0);
      continue;
    }
    std::map<double, std::vector<std::size_t>> by_number;
    const std::vector<double> numbers = numbers_of(*column, files[k]);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!std::isnan(numbers[i])) by_number[numbers[i]].push_back(i);
    for (auto& [number, rows] : by_number)
      frames.push_back(
          {.name = fmt::format("{:g}", number), .number = number, .file = &files[k], .rows = std::move(rows)});
  }
  if (frames.empty()) throw table.at("files").error("no row has the number of a frame");
  return frames;
}

/// Displacements of the record as its curve has them.
class FrameTimes {
 public:
  FrameTimes(const FieldSettings& settings, const MeasuredCurve& specimen, const std::filesystem::path& directory)
      : table_(settings.where), of_specimen_(settings.of_specimen), specimen_(specimen), directory_(directory) {}

  std::vector<double> of(const std::vector<FrameRows>& frames) const {
    if (table_.has("at")) return stated(frames.size());
    if (table_.has("rows")) return by_rows(frames.size());
    if (table_.has("displacement")) return by_column(frames);
    return matched(frames);
  }

 private:
  double as_curve(double in_file) const { return specimen_.displacement_factor * in_file - specimen_.origin; }

  void require_number(std::string_view key, std::size_t given, std::size_t frames) const {
    if (given != frames) throw table_.at(key).error(fmt::format("there are {} frames, and {} entries", frames, given));
  }

  std::vector<double> stated(std::size_t n) const {
    std::vector<double> found;
    const std::vector<ConfigValue> values = table_.at("at").list();
    require_number("at", values.size(), n);
    for (const ConfigValue& value : values) {
      const std::string text = value.string();
      const bool is_length = value.in_context([&] { return is_unit_of(unit_of(text), dimension::length); });
      found.push_back(is_length ? as_curve(value.quantity(dimension::length))
                                : at_force(value, specimen_.force_factor * value.quantity(dimension::force)));
    }
    return found;
  }

  double at_force(const ConfigValue& value, double force) const {
    const SampledCurve& curve = specimen_.curve;
    for (std::size_t i = 0; i + 1 < curve.x.size(); ++i) {
      const double a = curve.y[i] - force, b = curve.y[i + 1] - force;
      if (a <= 0.0 && b >= 0.0 && b > a) return curve.x[i] - a / (b - a) * (curve.x[i + 1] - curve.x[i]);
    }
    throw value.error(fmt::format("\"{}\" does not reach this force", curve.name));
  }

  /// Of the specimen's file, all rows.
  std::vector<double> column_of_curve(const ConfigTable& column) const {
    const CsvTable file = read_csv_of(of_specimen_, directory_);
    return read_column(column, file, "column", "unit", dimension::length);
  }

  std::vector<double> by_rows(std::size_t n) const {
    const std::vector<double> in_file = column_of_curve(of_specimen_.table("displacement"));
    std::vector<double> found;
    const std::vector<ConfigValue> rows = table_.at("rows").list();
    require_number("rows", rows.size(), n);
    for (const ConfigValue& value : rows) {
      const auto row = static_cast<std::size_t>(value.integer(Range{1.0, 1e9, false, "the number of a row, from 1"}));
      if (row > in_file.size() || std::isnan(in_file[row - 1]))
        throw value.error(fmt::format("the file of \"{}\" has {} rows, or none with a displacement there",
                                      specimen_.curve.name, in_file.size()));
      found.push_back(as_curve(in_file[row - 1]));
    }
    return found;
  }

  /// What the rows of each frame have first in a column of its file, which is read once; NaN of those without.
  template <class Read>
  static std::vector<double> of_each(const std::vector<FrameRows>& frames, const Read& read) {
    std::map<const CsvTable*, std::vector<double>> columns;
    std::vector<double> found;
    for (const FrameRows& frame : frames) {
      const auto [at, is_new] = columns.try_emplace(frame.file);
      if (is_new) at->second = read(*frame.file);
      const auto row = std::ranges::find_if(frame.rows, [&](std::size_t i) { return !std::isnan(at->second[i]); });
      found.push_back(row == frame.rows.end() ? std::numeric_limits<double>::quiet_NaN() : at->second[*row]);
    }
    return found;
  }

  std::vector<double> by_column(const std::vector<FrameRows>& frames) const {
    const ConfigTable column = table_.table("displacement");
    const double factor = column.number("factor", 1.0);
    std::vector<double> found = of_each(
        frames, [&](const CsvTable& file) { return read_column(column, file, "column", "unit", dimension::length); });
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (std::isnan(found[k])) throw column.error(fmt::format("frame {} has no displacement", frames[k].name));
      found[k] = as_curve(factor * found[k]);
    }
    return found;
  }

  std::vector<double> matched(const std::vector<FrameRows>& frames) const {
    const ConfigTable how = table_.table("matched");
    const CsvTable file = read_csv_of(of_specimen_, directory_);
    const std::vector<double> keys = numbers_of(how.at("curve_column"), file),
                              in_file = column_of_curve(of_specimen_.table("displacement"));
    std::vector<double> of_frames;
    if (how.has("column"))
      of_frames = of_each(frames, [&](const CsvTable& f) { return numbers_of(how.at("column"), f); });
    else
      std::ranges::transform(frames, std::back_inserter(of_frames), &FrameRows::number);
    std::vector<double> found;
    std::size_t n_matched = 0;
    for (const double key : of_frames) {
      found.push_back(std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; i + 1 < keys.size() && std::isnan(found.back()); ++i) {
        const double a = keys[i] - key, b = keys[i + 1] - key;
        if (a == 0.0) found.back() = as_curve(in_file[i]);
        if (a < 0.0 && b > 0.0) found.back() = as_curve(in_file[i] - a / (b - a) * (in_file[i + 1] - in_file[i]));
      }
      if (!keys.empty() && keys.back() == key) found.back() = as_curve(in_file.back());
      n_matched += std::isnan(found.back()) ? 0 : 1;
    }
    if (n_matched == 0)
      throw how.error(fmt::format("no frame has a row in the file of \"{}\": frames are {} to {}, rows {:g} to {:g}",
                                  specimen_.curve.name, frames.front().name, frames.back().name, keys.front(),
                                  keys.back()));
    return found;
  }

  const ConfigTable& table_;
  const ConfigTable& of_specimen_;
  const MeasuredCurve& specimen_;
  const std::filesystem::path& directory_;
};

/// The columns of a file that count.
struct FieldColumns {
  std::vector<double> x, y, z, u, v, w, quality;
  double least_quality = -std::numeric_limits<double>::infinity(), most_quality = -least_quality;
};

FieldColumns columns_of(const ConfigTable& table, const CsvTable& file) {
  FieldColumns columns;
  const auto required = [&](std::string_view key) {
    auto found = find_field_column(table, file, key);
    if (!found)
      throw table.error(
          fmt::format("no column of the file is known as \"{}\": name it, as {} = {{ column = \"...\" }}", key, key));
    return std::move(*found);
  };
  columns.x = required("x");
  columns.y = required("y");
  columns.u = required("u");
  columns.v = required("v");
  columns.z = find_field_column(table, file, "z").value_or(std::vector<double>{});
  columns.w = find_field_column(table, file, "w").value_or(std::vector<double>{});
  if (!table.has("quality")) return columns;
  const ConfigTable quality = table.table("quality");
  columns.quality = numbers_of(quality.at("column"), file);
  columns.least_quality = quality.number("at_least", columns.least_quality);
  columns.most_quality = quality.number("at_most", columns.most_quality);
  return columns;
}

RecordedFrame frame_of(const FrameRows& rows, const FieldColumns& c, double displacement, std::size_t& n_bad) {
  RecordedFrame frame{.name = rows.name, .displacement = displacement, .points = {}, .u = {}};
  for (const std::size_t i : rows.rows) {
    const Vector point(c.x[i], c.y[i], c.z.empty() ? 0.0 : c.z[i]), u(c.u[i], c.v[i], c.w.empty() ? 0.0 : c.w[i]);
    if (!point.allFinite() || !u.allFinite()) continue;
    if (!c.quality.empty() && !(c.quality[i] >= c.least_quality && c.quality[i] <= c.most_quality)) {
      ++n_bad;
      continue;
    }
    frame.points.push_back(point);
    frame.u.push_back(u);
  }
  return frame;
}

/// As those of the reference image, which no noise is in.
bool is_all_equal(const RecordedFrame& frame) {
  return frame.u.size() > 1 && std::ranges::all_of(frame.u, [&](const Vector& u) { return u == frame.u.front(); });
}

/// Columns of each file. All have displacements out of the plane, or none.
std::map<const CsvTable*, FieldColumns> columns_of(const ConfigTable& table, const std::vector<CsvTable>& files) {
  std::map<const CsvTable*, FieldColumns> columns;
  for (const CsvTable& file : files) columns.emplace(&file, columns_of(table, file));
  const auto has_w = [&](const CsvTable& file) { return !columns.at(&file).w.empty(); };
  const std::vector<ConfigValue> names = table.at("files").list();
  for (std::size_t k = 1; k < files.size(); ++k)
    if (has_w(files[k]) != has_w(files[0]))
      throw names[k].error(
          fmt::format("of \"{}\" and \"{}\" one has displacements along z (w) and the other has none; "
                      "give files that are alike",
                      names[0].string(), names[k].string()));
  return columns;
}

}  // namespace

RecordedField read_recorded_field(const FieldSettings& settings, const std::vector<MeasuredCurve>& specimens,
                                  const std::filesystem::path& case_directory) {
  RecordedField field = settings.field;
  const ConfigTable& table = settings.where;
  const std::vector<CsvTable> files = read_files(table, case_directory);
  const std::vector<FrameRows> frames = frames_of(table, files);
  const std::vector<double> at = FrameTimes(settings, specimens[field.specimen], case_directory).of(frames);
  const std::map<const CsvTable*, FieldColumns> columns = columns_of(table, files);
  field.n_components = columns.begin()->second.w.empty() ? 2 : 3;
  std::size_t n_bad = 0, n_unmatched = 0, n_equal = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (std::isnan(at[k])) {
      ++n_unmatched;
      continue;
    }
    RecordedFrame frame = frame_of(frames[k], columns.at(frames[k].file), at[k], n_bad);
    if (is_all_equal(frame))
      ++n_equal;
    else
      field.frames.push_back(std::move(frame));
  }
  const auto tell = [&](std::size_t n, std::string_view what) {
    if (n > 0) field.told.push_back(fmt::format("{} {}", n, what));
  };
  tell(n_unmatched, "frames left out: no row of the curve's file is theirs");
  tell(n_equal, "frames left out: all their displacements are equal, as of the reference image");
  tell(n_bad, "points left out by their quality");
  std::ranges::stable_sort(field.frames, {}, &RecordedFrame::displacement);
  if (std::ranges::all_of(field.frames, [](const RecordedFrame& frame) { return frame.points.size() < 3; }))
    throw table.error(fmt::format(
        "no frame has three points with values or more that are not all equal; {} frames were read", frames.size()));
  return field;
}

}  // namespace pfdm
