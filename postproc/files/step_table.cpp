#include "postproc/files/step_table.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfdm {

StepTable::StepTable(std::filesystem::path path, std::vector<std::string> names, std::optional<Index> last_step)
    : path_(std::move(path)), names_(std::move(names)) {
  if (last_step && std::filesystem::exists(path_)) read(*last_step);
  write();
}

void StepTable::read(Index last_step) {
  const std::string content = read_file(path_);
  std::string_view rest = content;
  const std::string header = fmt::format("{}", fmt::join(names_, ","));
  if (const std::string_view line = take_line(rest); line != header)
    throw InputError(fmt::format("{}, line 1: found \"{}\" instead of \"{}\"", path_.string(), line, header));
  for (int number = 2; !rest.empty(); ++number) {
    const std::string_view line = take_line(rest);
    std::vector<double> row;
    for (const std::string_view word : split_at_commas(line))
      if (const auto value = parse_double(word)) row.push_back(*value);
    if (row.size() != names_.size())
      throw InputError(
          fmt::format("{}, line {}: \"{}\" is not a row of {} numbers", path_.string(), number, line, names_.size()));
    if (row.front() <= static_cast<double>(last_step)) rows_.push_back(std::move(row));
  }
}

void StepTable::append(std::vector<double> row) {
  rows_.push_back(std::move(row));
  write();
}

void StepTable::write() const {
  std::string content = fmt::format("{}\n", fmt::join(names_, ","));
  for (const std::vector<double>& row : rows_) content += fmt::format("{}\n", fmt::join(row, ","));
  write_file(path_, content);
}

}  // namespace pfdm
