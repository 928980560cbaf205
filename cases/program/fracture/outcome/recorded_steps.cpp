#include "cases/program/fracture/outcome/recorded_steps.h"

#include "cases/program/fracture/outcome/energy_release_table.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "postproc/fields/checkpoint.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

InputError lacks_step(const fs::path& file, Index step, Index last_step) {
  return InputError(
      fmt::format("{}: step {} is missing, although the checkpoint beside it is of step {}: it was removed, cut or "
                  "replaced since the run",
                  file.string(), step, last_step));
}

/// `steps` of the rows of a file, in its order.
void require_all(const fs::path& file, const std::vector<Index>& steps, Index last_step) {
  for (Index step = 0; step <= last_step; ++step)
    if (as_size(step) >= steps.size() || steps[step] != step) throw lacks_step(file, step, last_step);
}

void require_curve(const fs::path& file, Index last_step) {
  std::vector<Index> steps;
  if (fs::exists(file))
    for (const CurveRow& row : read_curve(file)) steps.push_back(row.step);
  require_all(file, steps, last_step);
}

void require_table(const fs::path& file, std::vector<std::string> names, Index last_step) {
  std::vector<Index> steps;
  if (fs::exists(file)) {
    const CsvTable table = read_csv(file, {.whole_numbers = {names.front()}, .own_names = names});
    for (const double step : table.columns.front()) steps.push_back(static_cast<Index>(step));
  }
  require_all(file, steps, last_step);
}

void require_columns(const fs::path& folder, std::size_t n_sets, Index last_step) {
  const std::vector<ColumnRecord> records = read_columns(folder, last_step);
  if (records.size() < n_sets) throw lacks_step(folder, 0, last_step);
  for (const ColumnRecord& record : records)
    if (const auto n = count_of(record.steps); n <= last_step) throw lacks_step(folder / record.name, n, last_step);
}

void require_sense(const FractureState& state, const fs::path& file) {
  const bool has_place = state.step >= 0 && state.load >= 0.0 && state.increment > 0.0;
  if (has_place && is_finite(state)) return;
  throw InputError(fmt::format(
      "{}: this is no state of a run: {}: run the case again, without --restart", file.string(),
      has_place ? "some of its numbers are not finite"
                : fmt::format("step {}, load {}, next increment {}", state.step, state.load, state.increment)));
}

}  // namespace

void require_steps_up_to(const FractureState& state, const fs::path& results, const FractureCase& fracture,
                         std::size_t n_column_sets) {
  require_sense(state, results / checkpoint_file);
  require_curve(results / curve_file, state.step);
  if (n_column_sets > 0) require_columns(results / columns_folder, n_column_sets, state.step);
  if (!fracture.output.tips.empty())
    require_table(results / energy_release_file, energy_release_columns(fracture.output.tips), state.step);
  if (fracture.materials.has_fatigue()) require_table(results / fatigue_file, columns_of_fatigue(), state.step);
  if (fracture.box) require_table(results / means_file, columns_of_means(fracture.interfaces), state.step);
}

}  // namespace pfdm
