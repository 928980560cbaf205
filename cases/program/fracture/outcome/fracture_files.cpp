#include "cases/program/fracture/outcome/fracture_files.h"

#include "cases/program/fracture/outcome/energy_release_table.h"
#include "cases/program/fracture/outcome/heat_results.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/session/report_parts.h"
#include "postproc/cohesive/cohesive_results.h"
#include "postproc/cohesive/first_debonding.h"
#include "postproc/curves/comparison_results.h"
#include "postproc/exports/export_formats.h"
#include "postproc/fields/checkpoint.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/vtkhdf_frames.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

void require_results(const fs::path& results, const std::string& case_hash) {
  const fs::path checkpoint = results / checkpoint_file;
  if (!fs::exists(checkpoint) || !fs::exists(results / curve_file))
    throw InputError(fmt::format("{}: there are no results; pfdm run makes them", results.string()));
  read_checkpoint(checkpoint, case_hash);  // refuses another case's
}

// The frames that a .pvd lists, or those in one file.
std::vector<StoredStep> steps_of(const fs::path& results, const char* list, const char* one_file) {
  const bool in_one = !fs::exists(results / list);
  if (in_one && !fs::exists(results / one_file)) return {};
  std::vector<StoredStep> steps;
  for (const Frame& frame : in_one ? frames_in(results / one_file) : read_pvd(results / list)) {
    const std::string name = fs::path(frame.file).stem().string();
    const auto step = parse_int(std::string_view(name).substr(std::min(name.find('_') + 1, name.size())));
    if (!step)
      throw InputError(fmt::format("{}: \"{}\" is not a frame that pfdm wrote",
                                   (results / (in_one ? one_file : list)).string(), name));
    steps.push_back({*step, in_one ? frame_in_one_file(results / one_file, steps.size()) : results / frame.file});
  }
  return steps;
}

}  // namespace

std::string frame_file(Index step) { return fmt::format("{}/step_{:06}.vtu", frames_folder, step); }

std::string interfaces_frame_file(Index step) { return fmt::format("{}/step_{:06}.vtu", interfaces_folder, step); }

bool is_frame(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("step_") && name.ends_with(".vtu");
}

void remove_what_was_made_of_them(const fs::path& directory) {
  std::error_code ignored;  // what cannot be removed will not be writable either, and that is said then
  fs::remove(directory / summary_file, ignored);
  for (const char* file : {frames_in_one_file, interfaces_in_one_file}) fs::remove(directory / file, ignored);
  for (const char* file : cohesive_files) fs::remove(directory / file, ignored);
  remove_exports(directory);
  for (const char* file : comparison_files) fs::remove(directory / file, ignored);
  remove_report(directory);
}

std::optional<FractureState> find_checkpoint(const fs::path& results, const std::string& case_hash) {
  const fs::path file = results / checkpoint_file;
  if (!fs::exists(file)) return std::nullopt;
  return read_checkpoint(file, case_hash);
}

bool has_results(const fs::path& results) {
  return fs::exists(results / checkpoint_file) || fs::exists(results / summary_file);
}

void remove_earlier_run(const fs::path& directory) {
  remove_what_was_made_of_them(directory);
  std::error_code ignored;
  for (const char* file :
       {checkpoint_file, curve_file, frames_file, energy_release_file, interfaces_file, means_file, homogenized_file,
        load_cases_file, first_debonding_file, heat_file, heat_over_time_file, heated_file, fatigue_file})
    fs::remove(directory / file, ignored);
  remove_columns(directory / columns_folder);
  for (const char* folder : {frames_folder, interfaces_folder})
    for (const auto& entry : fs::directory_iterator(directory / folder, ignored))
      if (is_frame(entry.path())) fs::remove(entry.path(), ignored);
}

std::vector<CurveRow> read_curve_record(const fs::path& results, const std::string& case_hash) {
  require_results(results, case_hash);
  std::vector<CurveRow> rows = read_curve(results / curve_file);
  if (rows.empty())
    throw InputError(fmt::format("{}: it has no rows; pfdm run makes it anew", (results / curve_file).string()));
  return rows;
}

std::vector<ColumnRecord> read_column_record(const fs::path& results, const std::string& case_hash) {
  require_results(results, case_hash);
  std::vector<ColumnRecord> records = read_columns(results / columns_folder);
  if (records.empty())
    throw InputError(
        fmt::format("{}: the run recorded no columns: name the surfaces in [cohesive] of case.toml, and run it again "
                    "(particles with layers are recorded without)",
                    results.string()));
  return records;
}

std::vector<ColumnRecord> find_column_record(const fs::path& results) { return read_columns(results / columns_folder); }

std::optional<RunSummary> find_summary(const fs::path& results) {
  if (!fs::exists(results / summary_file)) return std::nullopt;
  return read_run_summary(results / summary_file);
}

std::vector<StoredStep> stored_steps(const fs::path& results) {
  return steps_of(results, frames_file, frames_in_one_file);
}

std::vector<StoredStep> stored_interfaces(const fs::path& results) {
  return steps_of(results, interfaces_file, interfaces_in_one_file);
}

std::vector<std::string> columns_of_fatigue() {
  return {"step", "load", "cycles", "jumped_cycles", "greatest_energy_over_threshold", "least_toughness_factor"};
}

std::vector<double> row_of_fatigue(const StepReport& report) {
  const FatigueReport fatigue = report.fatigue.value_or(FatigueReport());
  return {static_cast<double>(report.step), report.load,         fatigue.cycles, fatigue.jumped_cycles,
          fatigue.greatest_energy,          fatigue.least_factor};
}

}  // namespace pfdm
