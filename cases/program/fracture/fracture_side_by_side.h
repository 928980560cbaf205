#pragma once
// Debonding angle and energies of a run beside those of its experiment, or of another run of the same body, on the page
// of pfdm report.

#include "cases/program/fracture/experiment_case.h"
#include "postproc/cohesive/column_record.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/page/report_page.h"

#include <vector>

namespace pfdm {

/// A chart for the debonding angle and one for each kind of energy that the experiment names, and a table of their
/// differences and the force's; nothing without any. `component` of the curve's force. Throws InputError like pfdm
/// compare.
std::vector<PageRow> side_by_side_rows(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                                       int component, const std::vector<ColumnRecord>& records);

}  // namespace pfdm
