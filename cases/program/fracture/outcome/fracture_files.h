#pragma once
// The files that a fracture run leaves in its results directory: their names, what they tell, and how they go away.

#include "postproc/cohesive/column_record.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/curves/summary.h"
#include "solver/fracture/model/state.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* checkpoint_file = "checkpoint.bin";
inline constexpr const char* columns_folder = "columns";
inline constexpr const char* fatigue_file = "fatigue.csv";
inline constexpr const char* frames_file = "fields.pvd";
inline constexpr const char* frames_in_one_file = "fields.vtkhdf";
inline constexpr const char* frames_folder = "fields";
inline constexpr const char* interfaces_file = "interfaces.pvd";
inline constexpr const char* interfaces_in_one_file = "interfaces.vtkhdf";
inline constexpr const char* interfaces_folder = "interfaces";

/// The frame of a step, relative to the results; in the order of the steps, so are the names.
std::string frame_file(Index step);
std::string interfaces_frame_file(Index step);
bool is_frame(const std::filesystem::path& file);

/// The state to restart from; none if there is no checkpoint. Throws InputError if it belongs to another case.
std::optional<FractureState> find_checkpoint(const std::filesystem::path& results, const std::string& case_hash);

/// Whether the directory holds results of a run, complete or not.
bool has_results(const std::filesystem::path& results);

/// Removes the files of a run, and of the six load cases of a box that is linear. Killed in between it leaves what is
/// complete, what can be continued, or what nobody takes for results.
void remove_earlier_run(const std::filesystem::path& directory);

/// Removes what other commands, and the end of the run, made of the steps that are there.
void remove_what_was_made_of_them(const std::filesystem::path& directory);

/// What the columns of a run told. Throws InputError if there is no such record, or if the results belong to another
/// case.
std::vector<ColumnRecord> read_column_record(const std::filesystem::path& results, const std::string& case_hash);

/// The force-displacement curve of a run; throws likewise.
std::vector<CurveRow> read_curve_record(const std::filesystem::path& results, const std::string& case_hash);

/// The record of the columns, or nothing; for a look at results that are known to belong to the case.
std::vector<ColumnRecord> find_column_record(const std::filesystem::path& results);

/// What the run said of itself when it ended; none while it has not.
std::optional<RunSummary> find_summary(const std::filesystem::path& results);

struct StoredStep {
  Index step = 0;
  std::filesystem::path file;  ///< .vtu
};
/// The frames, in the order of their steps; none if there is no list of them.
std::vector<StoredStep> stored_steps(const std::filesystem::path& results);
/// Those of the cohesive interfaces.
std::vector<StoredStep> stored_interfaces(const std::filesystem::path& results);

std::vector<std::string> columns_of_fatigue();  ///< of fatigue_file, a row for each load step
std::vector<double> row_of_fatigue(const StepReport& report);

}  // namespace pfdm
