#pragma once
// history.csv: what a material point went through, a row per increment.

#include "postproc/files/csv_table.h"
#include "solver/point/mixed_control.h"

#include <cstdint>
#include <map>
#include <string>

namespace pfdm {

/// time_s, the twelve components of stress and (tensor) strain, plastic strain, z, zeta, dissipation, free energy,
/// external work, and what the increment cost.
CsvTable history_table(const EndochronicLaw& law, const HistoryResult& history);

/// Of all increments.
std::int64_t newton_iterations(const HistoryResult& history);

/// Headline figures with their unit in the name, for summary.json.
std::map<std::string, double> history_figures(const EndochronicLaw& law, const HistoryResult& history);

}  // namespace pfdm
