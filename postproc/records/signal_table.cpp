#include "postproc/records/signal_table.h"

#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/text_file.h"

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
  constexpr std::pair<std::string_view, Reader> readers[] = {{".mat", read_signals_mat},   {".uff", read_signals_uff},
                                                             {".unv", read_signals_uff},   {".h5", read_signals_hdf5},
                                                             {".hdf5", read_signals_hdf5}, {".wav", read_signals_wav}};
  for (const auto& [extension, read] : readers)
    if (suffix == extension) return read(path);
  throw InputError(
      fmt::format("{}: records are read from .csv, .mat, .uff, .unv, .h5, .hdf5 and .wav files", path.string()));
}

}  // namespace pfdm
