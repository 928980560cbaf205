#pragma once
// What a run writes of heat: a table by load step, and after cycles of load the long time that their mean heat warms.

#include "cases/program/fracture/running_case.h"
#include "postproc/browser/browser_page.h"
#include "postproc/curves/summary.h"
#include "postproc/files/step_table.h"
#include "solver/fracture/state.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* heat_file = "heat.csv";
inline constexpr const char* heat_over_time_file = "heat_over_time.csv";
inline constexpr const char* heated_file = "heated.vtu";

std::vector<std::string> columns_of_heat();  ///< of heat_file
/// `duration`: of a load parameter of 1 [s].
std::vector<double> row_of_heat(const StepReport& report, double duration);
/// Of the last row, for the summary.
std::map<std::string, double> figures_of_heat(const StepTable& table);

/// Of a summary's figures: where a body is hottest, and by how much; after the long time under the mean heat of cycles,
/// or else after the last step. None without [heat].
std::optional<HeadFigure> figure_of_hottest_place(const FractureCase& fracture, const RunSummary& summary);

/// Warns of cycles that do not repeat. With [heat] time, writes heat_over_time_file and heated_file, the rises at its
/// end, says what came out, and returns the figures; nothing before a whole cycle.
std::map<std::string, double> heat_at_the_end(RunningCase& running);

}  // namespace pfdm
