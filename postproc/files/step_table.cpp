#include "postproc/files/step_table.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfdm {

StepTable::StepTable(std::filesystem::path path, std::vector<std::string> names, std::optional<Index> last_step)
    : path_(std::move(path)), names_(std::move(names)) {
  if (last_step && std::filesystem::exists(path_)) read(*last_step);
  write();
}

void StepTable::read(Index last_step) {
  const CsvTable table = read_csv(path_, {.own_names = names_});
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    if (!(table.columns.front()[i] <= static_cast<double>(last_step))) continue;
    std::vector<double>& row = rows_.emplace_back();
    for (const std::vector<double>& column : table.columns) row.push_back(column[i]);
  }
}

void StepTable::append(std::vector<double> row, bool now) {
  rows_.push_back(std::move(row));
  if (now) write();
}

void StepTable::write() const {
  std::string content = fmt::format("{}\n", fmt::join(names_, ","));
  for (const std::vector<double>& row : rows_) content += fmt::format("{}\n", fmt::join(row, ","));
  write_file(path_, content);
}

}  // namespace pfdm
