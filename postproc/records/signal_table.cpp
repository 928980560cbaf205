#include "postproc/records/signal_table.h"

#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/text_file.h"
#include "postproc/records/separate_reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace pfdm {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) lines.emplace_back(take_line(text));
  return lines;
}

}  // namespace

SignalTable read_signals_csv(const std::filesystem::path& path, const SignalText& text) {
  const CsvTable csv = read_csv(
      path, {.has_units = true, .has_gaps = true, .is_foreign = true, .marks = text.marks, .is_unit = text.is_unit});
  SignalTable table{.remark = fmt::format("{}", fmt::join(csv.comments, "\n")), .columns = {}};
  for (std::size_t i = 0; i < csv.names.size(); ++i) {
    const std::vector<double>& values = csv.columns[i];
    table.columns.push_back({csv.has_names() ? csv.names[i] : fmt::format("{}", i + 1),
                             csv.units.empty() ? "" : csv.units[i],
                             Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)), csv.faults[i]});
  }
  return table;
}

void write_signals_csv(const std::filesystem::path& path, const SignalTable& table) {
  CsvTable csv;
  csv.comments = lines_of(table.remark);
  for (const SignalColumn& column : table.columns) {
    csv.add(column.name, {column.values.begin(), column.values.end()});
    csv.units.push_back(column.unit);
  }
  write_csv(path, csv);
}

SignalTable read_signals(const std::filesystem::path& path, const SignalText& text) {
  const std::string suffix = lower_case(path.extension().string());
  if (suffix == ".csv") return read_signals_csv(path, text);
  using Reader = SignalTable (*)(const std::filesystem::path&);
  struct Format {
    std::string_view extension;
    Reader read;
    bool by_foreign_library;
  };
  constexpr Format formats[] = {{".mat", read_signals_mat, true},   {".uff", read_signals_uff, false},
                                {".unv", read_signals_uff, false},  {".h5", read_signals_hdf5, true},
                                {".hdf5", read_signals_hdf5, true}, {".wav", read_signals_wav, true}};
  for (const Format& format : formats)
    if (suffix == format.extension)
      return format.by_foreign_library ? read_separately(path, format.read) : format.read(path);
  throw InputError(
      fmt::format("{}: records are read from .csv, .mat, .uff, .unv, .h5, .hdf5 and .wav files", path.string()));
}

}  // namespace pfdm
