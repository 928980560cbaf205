#include "cases/program/vibration/vibration_reader.h"

#include "cases/program/input/config/csv_keys.h"
#include "cases/program/input/config/units.h"
#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/text_file.h"
#include "postproc/records/signal_table.h"
#include "solver/vibration/diagnosis/vibration_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

std::vector<std::string> names_of_columns(const SignalTable& table) {
  std::vector<std::string> names;
  for (const SignalColumn& column : table.columns) names.push_back(column.name);
  return names;
}

const SignalColumn& column_of(const SignalTable& table, const std::string& name, const std::filesystem::path& file) {
  try {
    const SignalColumn& column = table.columns[find_name(names_of_columns(table), name)];
    if (column.fault.empty()) return column;
    throw InputError(column.fault);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// Beyond what machines record: a damaged file or a wrong unit. In the SI unit of the column.
void require_recordable(const Eigen::VectorXd& values, const SignalColumn& column, const Dimension& due,
                        const std::filesystem::path& file) {
  constexpr double most = 1e9;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (std::abs(values[i]) > most)
      throw InputError(fmt::format(
          "{}: column \"{}\": sample {} is {:.3g} {}; a record has less than {:g} {}: is the unit right, and "
          "the file whole?",
          file.string(), column.name, i + 1, values[i], due.si_unit, most, due.si_unit));
}

/// Values in the SI unit of `due`.
Eigen::VectorXd in_si(const SignalColumn& column, const std::optional<std::string>& stated, const Dimension& due,
                      const std::filesystem::path& file) {
  const std::string unit = stated ? *stated : column.unit;
  if (unit.empty())
    throw InputError(fmt::format("{}: column \"{}\" has no unit; expected {}, as in \"{}\"", file.string(), column.name,
                                 with_article(due.name), due.si_unit));
  double factor = 1.0;
  try {
    factor = unit_in_si(unit, due);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: column \"{}\": {}", file.string(), column.name, error.what()));
  }
  Eigen::VectorXd values = column.values * factor;
  require_recordable(values, column, due, file);
  return values;
}

Eigen::VectorXd acceleration(const SignalTable& table, const std::string& name, const std::optional<std::string>& unit,
                             const std::filesystem::path& file) {
  return in_si(column_of(table, name, file), unit, dimension::acceleration, file);
}

/// Of times without a unit: that with which they give the rate that is stated, if there is one; else seconds.
std::string likely_unit(const SignalColumn& column, const RecordFile& source) {
  const double rate = source.rate.value_or(source.usual_rate);
  const auto n = column.values.size();
  if (n < 2) return "s";
  const double step = (column.values[n - 1] - column.values[0]) / static_cast<double>(n - 1);
  for (const char* unit : {"s", "ms", "us", "ns"})
    if (std::abs(rate * step * unit_in_si(unit, dimension::time) - 1.0) < 0.01) return unit;
  return "s";
}

/// Null if the table has none that the case does not name; nor where they are clocks, as 10:00:01, and the rate is
/// stated.
const SignalColumn* find_times(const SignalTable& table, const RecordFile& source) {
  const auto is_meant = [&](const SignalColumn& column) {
    const std::string time = lower_case(source.time);
    return lower_case(column.name) == time || lower_case(without_unit(column.name)) == time;
  };
  const auto found = std::ranges::find_if(table.columns, is_meant);
  return found == table.columns.end() || (source.rate && !source.names_time && !found->fault.empty()) ? nullptr
                                                                                                      : &*found;
}

std::optional<Eigen::VectorXd> times(const SignalTable& table, const RecordFile& source,
                                     const std::filesystem::path& file, std::vector<std::string>& notes) {
  if (find_times(table, source) == nullptr && !source.names_time) return std::nullopt;
  const SignalColumn& column = column_of(table, source.time, file);
  if (source.time_unit || !column.unit.empty()) return in_si(column, source.time_unit, dimension::time, file);
  const std::string unit = likely_unit(column, source);
  if (unit != "s")
    notes.push_back(fmt::format("the times in \"{}\" have no unit: {} gives the rate that is stated (time_unit)",
                                column.name, unit));
  return in_si(column, unit, dimension::time, file);
}

/// A channel of a file with the times of its samples, if the file has them.
struct Channel {
  std::optional<Eigen::VectorXd> time;
  Eigen::VectorXd values;

  void keep(Eigen::Index first, Eigen::Index n) {
    values = values.segment(first, n).eval();
    if (time) time = time->segment(first, n).eval();
  }
};

/// Samples of one file by which the other begins earlier, by their clocks; 0 without clocks.
Eigen::Index samples_apart(const Channel& early, const Channel& late, const std::filesystem::path& file) {
  if (!early.time || !late.time || early.time->size() < 2 || late.time->size() < 2) return 0;
  const auto step = [](const Eigen::VectorXd& t) {
    return (t[t.size() - 1] - t[0]) / static_cast<double>(t.size() - 1);
  };
  const double h = step(*early.time);
  if (!(std::abs(step(*late.time) / h - 1.0) < 1e-3))
    throw InputError(fmt::format("{}: it has {:.6g} samples per second, the other file {:.6g}", file.string(), 1.0 / h,
                                 1.0 / step(*late.time)));
  const double apart = ((*late.time)[0] - (*early.time)[0]) / h;
  if (!(std::abs(apart - std::round(apart)) < 0.1))
    throw InputError(
        fmt::format("{}: its samples lie {:.3g} of a sampling interval beside those of the other file; bring "
                    "both on the same times",
                    file.string(), std::abs(apart - std::floor(apart))));
  return std::llround(apart);
}

/// Cuts two channels to what both have, by their clocks; without clocks both begin together.
void cut_to_common(Channel& base, Channel& mass, const RecordFile& source, std::vector<std::string>& notes) {
  const Eigen::Index apart = samples_apart(base, mass, *source.base_file);
  const Eigen::Index of_base = std::max<Eigen::Index>(apart, 0), of_mass = std::max<Eigen::Index>(-apart, 0);
  const Eigen::Index n = std::min(base.values.size() - of_base, mass.values.size() - of_mass);
  if (n < 1) throw InputError(fmt::format("{}: the times of the two files do not overlap", source.base_file->string()));
  if (n < std::max(base.values.size(), mass.values.size()))
    notes.push_back(fmt::format(
        "the base's file has {} samples, the mass's {}: {} that both have from the {}'s sample {} on",
        base.values.size(), mass.values.size(), n, of_base > 0 ? "base" : "mass", 1 + std::max(of_base, of_mass)));
  base.keep(of_base, n);
  mass.keep(of_mass, n);
}

/// Tells how to change a fault that follows from times without a unit.
std::string time_unit_hint(const SignalTable& table, const RecordFile& source, const RecordFault& fault) {
  const bool of_rate = fault.name == "sampled_too_slowly" || fault.name == "too_short" || fault.name == "wrong_rate";
  const SignalColumn* column = of_rate && !source.time_unit ? find_times(table, source) : nullptr;
  return column != nullptr && column->unit.empty() && likely_unit(*column, source) == "s"
             ? "; its times have no unit and count as seconds (time_unit = \"us\" or another changes that)"
             : "";
}

SignalTable read_table(const RecordFile& source, const std::filesystem::path& file, std::vector<std::string>& notes) {
  SignalTable table = read_signals(file, {.marks = source.marks, .is_unit = is_unit});
  for (const std::string& note : table.notes) notes.push_back(fmt::format("{}: {}", file.string(), note));
  return table;
}

Channel base_of(const SignalTable& table, const RecordFile& source, const std::filesystem::path& file,
                std::vector<std::string>& notes) {
  return {.time = times(table, source, file, notes),
          .values = acceleration(table, source.base, source.base_unit, file)};
}

RawRecord raw_record(const VibrationTest& test, const RecordFile& source, const SignalTable& table,
                     std::vector<std::string>& notes) {
  Channel base = base_of(source.base_file ? read_table(source, *source.base_file, notes) : table, source,
                         source.base_file.value_or(source.file), notes);
  Channel mass{.time = times(table, source, source.file, notes),
               .values = acceleration(table, source.relative, source.relative_unit, source.file)};
  if (source.base_file) cut_to_common(base, mass, source, notes);
  return {.time = std::move(mass.time),
          .base = std::move(base.values),
          .relative = std::move(mass.values),
          .rate = source.rate,
          .band_low = test.band_low,
          .band_high = test.band_high};
}

/// Those with which the record can be used, a sentence each; a base at rest is made so. Throws InputError for others.
std::vector<std::string> faults_of(RawRecord& raw, const RecordFile& source, const SignalTable& table, Log& log) {
  std::vector<std::string> faults;
  for (const RecordFault& fault : check_record(raw)) {
    const std::string message = fmt::format("{}: {}: {}{}", source.file.string(), fault.name, fault.message,
                                            time_unit_hint(table, source, fault));
    if (fault.refused) throw InputError(message);
    log.warn(message);
    if (fault.name == "base_at_rest")  // which speaks against nothing
      raw.base.setZero();
    else
      faults.push_back(fmt::format("{}: {}", fault.name, fault.message));
  }
  return faults;
}

}  // namespace

VibrationRecord read_record(const VibrationTest& test, const RecordFile& source, Log& log) {
  std::vector<std::string> notes;
  const SignalTable table = read_table(source, source.file, notes);
  RawRecord raw = raw_record(test, source, table, notes);
  std::ranges::sort(notes);
  notes.erase(std::unique(notes.begin(), notes.end()), notes.end());
  for (const std::string& note : notes) log.say(fmt::format("test {}: {}", test.name, note));
  std::vector<std::string> faults = faults_of(raw, source, table, log);
  if (source.absolute) raw.relative -= raw.base;
  return {.name = test.name,
          .rate = sampling_rate(raw),
          .base = raw.base.array() - raw.base.mean(),
          .relative = raw.relative.array() - raw.relative.mean(),
          .band_low = test.band_low,
          .band_high = test.band_high,
          .remark = table.remark,
          .faults = std::move(faults)};
}

SampledChannel read_channel(const RecordFile& source) {
  std::vector<std::string> notes;
  Channel base = base_of(read_table(source, source.file, notes), source, source.file, notes);
  RawRecord raw{.time = std::move(base.time),
                .base = std::move(base.values),
                .relative = {},
                .rate = source.rate,
                .band_low = 1.0,
                .band_high = 1.0};
  raw.relative = raw.base;
  for (const RecordFault& fault : check_record(raw))
    if (fault.refused && fault.name != "too_short" && fault.name != "sampled_too_slowly")
      throw InputError(fmt::format("{}: {}: {}", source.file.string(), fault.name, fault.message));
  return {.values = raw.base, .rate = sampling_rate(raw), .notes = std::move(notes)};
}

std::vector<Key> record_file_keys(std::string_view only) {
  using namespace keys;
  std::vector<Key> rows{
      {"file", path(), "", "File of the record: CSV, MATLAB, universal, HDF5 or WAV, seen from the case."},
      {"base", text("column"), "\"base_acceleration\"", "Column of the base's acceleration."},
      {"relative", text("column"), "\"relative_acceleration\"", "Column of the relative acceleration of the mass."},
      {"time", text("column"), "\"time\"", "Column of the time."},
      {"time_unit", text("unit"), "seconds", "Unit of the time, where the file does not state it."},
      {"unit", text("unit"), "that of the file",
       "Unit of the channels, where the file does not state it; of WAV the full scale."},
      {"rate", quantity(dimension::frequency, range::positive), "that of the file",
       "Samples per second, where the file does not state them."}};
  for (Key& row : rows) row.only = only;
  std::vector<Key> marks = csv_mark_keys();
  for (Key& row : marks) row.only = only;
  return joined({rows, marks});
}

}  // namespace pfdm
