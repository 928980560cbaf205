#include "postproc/displacements/place_record.h"

#include "postproc/files/csv_table.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

constexpr const char* place_file = "displacements_at_places.csv";

std::vector<std::string> names_of(std::size_t n_places) {
  std::vector<std::string> names{"step"};
  for (std::size_t k = 0; k < n_places; ++k)
    for (const char axis : {'x', 'y', 'z'}) names.push_back(fmt::format("u{}_{}_m", k, axis));
  return names;
}

}  // namespace

PlaceRecord::PlaceRecord(const std::filesystem::path& folder, std::size_t n_places, std::optional<Index> last_step)
    : table_(folder / place_file, names_of(n_places), last_step) {}

void PlaceRecord::append(Index step, const std::vector<Vector>& displacements, bool now) {
  std::vector<double> row{static_cast<double>(step)};
  for (const Vector& u : displacements) row.insert(row.end(), u.begin(), u.end());
  table_.append(std::move(row), now);
}

std::vector<std::vector<double>> read_place_record(const std::filesystem::path& folder) {
  const CsvTable table = read_csv(folder / place_file);
  std::vector<std::vector<double>> rows(table.n_rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].reserve(table.columns.size() - 1);
    for (std::size_t k = 1; k < table.columns.size(); ++k) rows[i].push_back(table.columns[k][i]);
  }
  return rows;
}

}  // namespace pfdm
