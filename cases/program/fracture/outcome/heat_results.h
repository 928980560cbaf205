#pragma once
// What a run writes of heat: a table by load step; and its figures, which the tables of heat and the summary share.

#include "cases/program/fracture/case/fracture_case.h"
#include "postproc/browser/browser_page.h"
#include "postproc/curves/summary.h"
#include "postproc/files/step_table.h"
#include "solver/fracture/model/state.h"
#include "solver/heat/heat_state.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* heat_file = "heat.csv";
inline constexpr const char* heat_over_time_file = "heat_over_time.csv";
inline constexpr const char* heated_file = "heated.vtu";

std::vector<std::string> columns_of_heat();  ///< of heat_file
std::vector<double> row_of_heat(const StepReport& report);
/// Of the last row, for the summary.
std::map<std::string, double> figures_of_heat(const StepTable& table);

/// Of a summary's figures: where a body is hottest, and by how much; after the long time under the mean heat of cycles,
/// or else after the last step. None without [heat].
std::optional<HeadFigure> figure_of_hottest_place(const FractureCase& fracture, const RunSummary& summary);

/// These columns, and those that every table of heat ends with.
std::vector<std::string> with_heat_figures(std::vector<std::string> names);
void add_heat_figures(const HeatFigures& at, const HeatBalance& account, std::vector<double>& row);
/// By the summary's names, `what`_COLUMN: of these columns' values, in their order.
std::map<std::string, double> named_heat_figures(const std::string& what, std::span<const double> values);

}  // namespace pfdm
