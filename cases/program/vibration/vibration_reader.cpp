#include "cases/program/vibration/vibration_reader.h"

#include "cases/program/input/units.h"
#include "physics/error.h"
#include "postproc/records/signal_table.h"
#include "solver/vibration/vibration_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

const SignalColumn* find_column(const SignalTable& table, const std::string& name) {
  const auto found = std::ranges::find(table.columns, name, &SignalColumn::name);
  return found == table.columns.end() ? nullptr : &*found;
}

/// Values in the SI unit of `due`.
Eigen::VectorXd in_si(const SignalColumn& column, const std::optional<std::string>& stated, const Dimension& due,
                      const std::filesystem::path& file) {
  const std::string unit = stated ? *stated : column.unit;
  if (unit.empty())
    throw InputError(fmt::format("{}: column \"{}\" has no unit; expected {}, as in \"{}\"", file.string(), column.name,
                                 with_article(due.name), due.si_unit));
  try {
    return column.values * unit_in_si(unit, due);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: column \"{}\": {}", file.string(), column.name, error.what()));
  }
}

Eigen::VectorXd acceleration(const SignalTable& table, const std::string& name, const std::optional<std::string>& unit,
                             const RecordFile& source) {
  const SignalColumn* column = find_column(table, name);
  if (column != nullptr) return in_si(*column, unit, dimension::acceleration, source.file);
  std::vector<std::string> names;
  for (const SignalColumn& c : table.columns) names.push_back(c.name);
  throw InputError(
      fmt::format("{}: there is no column \"{}\" (available: {})", source.file.string(), name, fmt::join(names, ", ")));
}

std::optional<Eigen::VectorXd> times(const SignalTable& table, const RecordFile& source) {
  const SignalColumn* column = find_column(table, source.time);
  if (column == nullptr) return std::nullopt;
  return in_si(*column, column->unit.empty() ? std::optional<std::string>("s") : std::nullopt, dimension::time,
               source.file);
}

}  // namespace

VibrationRecord read_record(const VibrationTest& test, const RecordFile& source, Log& log) {
  const SignalTable table = read_signals(source.file, source.marks);
  RawRecord raw{.time = times(table, source),
                .base = acceleration(table, source.base, source.base_unit, source),
                .relative = acceleration(table, source.relative, source.relative_unit, source),
                .rate = source.rate,
                .band_low = test.band_low,
                .band_high = test.band_high};
  std::vector<std::string> faults;
  for (const RecordFault& fault : check_record(raw)) {
    const std::string message = fmt::format("{}: {}: {}", source.file.string(), fault.name, fault.message);
    if (fault.refused) throw InputError(message);
    log.warn(message);
    faults.push_back(fmt::format("{}: {}", fault.name, fault.message));
  }
  if (source.absolute) raw.relative -= raw.base;
  VibrationRecord record{.name = test.name,
                         .rate = sampling_rate(raw),
                         .base = raw.base.array() - raw.base.mean(),
                         .relative = raw.relative.array() - raw.relative.mean(),
                         .band_low = test.band_low,
                         .band_high = test.band_high,
                         .remark = table.remark,
                         .faults = std::move(faults)};
  return record;
}

SampledChannel read_channel(const RecordFile& source) {
  const SignalTable table = read_signals(source.file, source.marks);
  RawRecord raw{.time = times(table, source),
                .base = acceleration(table, source.base, source.base_unit, source),
                .relative = {},
                .rate = source.rate,
                .band_low = 1.0,
                .band_high = 1.0};
  raw.relative = raw.base;
  for (const RecordFault& fault : check_record(raw))
    if (fault.refused && fault.name != "too_short" && fault.name != "sampled_too_slowly")
      throw InputError(fmt::format("{}: {}: {}", source.file.string(), fault.name, fault.message));
  return {.values = raw.base, .rate = sampling_rate(raw)};
}

}  // namespace pfdm
