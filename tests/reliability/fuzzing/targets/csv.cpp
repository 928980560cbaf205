// Tables of testing machines and spreadsheets, and those that this program wrote.

#include "cases/program/input/config/units.h"
#include "postproc/files/csv_table.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <cmath>

namespace pfdm::fuzzing {
namespace {

CsvOptions options_of(unsigned choice) {
  constexpr std::optional<char> separators[] = {std::nullopt, ',', ';', '\t', ' '};
  constexpr std::optional<char> thousands[] = {std::nullopt, '\'', '.', ' '};
  if (choice % 4 == 0) return {.whole_numbers = {"step"}, .own_names = {"step", "load", "force"}};
  CsvOptions options{.has_units = (choice & 4U) != 0, .has_gaps = (choice & 8U) != 0, .is_foreign = choice % 4 != 1};
  if (!options.is_foreign) return options;
  if ((choice & 2U) != 0) options.is_unit = is_unit;
  options.marks = {.separator = separators[(choice / 16) % 5], .thousands = thousands[(choice / 64) % 4]};
  return options;
}

}  // namespace
}  // namespace pfdm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  std::string_view input = text_of(data, size);
  const CsvOptions options = options_of(take_choice(input));
  is_read([&] {
    const CsvTable table = read_csv(file_of(input, "table.csv"), options);
    require(table.columns.size() == table.names.size());
    for (const std::vector<double>& column : table.columns) {
      require(column.size() == table.n_rows());
      for (const double value : column)
        require(options.has_gaps || options.is_foreign || !options.own_names.empty() || std::isfinite(value));
    }
    for (const std::string& name : table.names) is_read([&] { require(table.find(name) < table.names.size()); });
  });
  return 0;
}
