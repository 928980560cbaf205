#include "postproc/files/step_table.h"

#include "postproc/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>

namespace pfdm {
namespace {

using Rows = std::vector<std::vector<double>>;

Rows rows_up_to(Index last_step, const std::filesystem::path& path, const std::vector<std::string>& names) {
  const CsvTable table = read_csv(path, {.own_names = names});
  Rows rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    if (!(table.columns.front()[i] <= static_cast<double>(last_step))) continue;
    std::vector<double>& row = rows.emplace_back();
    for (const std::vector<double>& column : table.columns) row.push_back(column[i]);
  }
  return rows;
}

std::string lines_of(std::span<const std::vector<double>> rows) {
  std::string lines;
  for (const std::vector<double>& row : rows) lines += fmt::format("{}\n", fmt::join(row, ","));
  return lines;
}

}  // namespace

StepTable::StepTable(std::filesystem::path path, std::vector<std::string> names, std::optional<Index> last_step)
    : names_(std::move(names)),
      rows_(last_step && std::filesystem::exists(path) ? rows_up_to(*last_step, path, names_) : Rows()),
      file_(std::move(path), text()),
      n_written_(rows_.size()) {}

void StepTable::append(std::vector<double> row, bool now) {
  rows_.push_back(std::move(row));
  if (now) write();
}

std::string StepTable::text() const { return fmt::format("{}\n", fmt::join(names_, ",")) + lines_of(rows_); }

void StepTable::write() {
  file_.append(lines_of(std::span(rows_).subspan(n_written_)), [this] { return text(); });
  n_written_ = rows_.size();
}

}  // namespace pfdm
