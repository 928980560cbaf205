#pragma once
// Debonding angle and energies of a run beside those of its experiment, or of another run of the same body, on the page
// of pfdm report.

#include "cases/program/fracture/case/experiment_case.h"
#include "postproc/cohesive/column_record.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/page/report_page.h"

#include <optional>
#include <vector>

namespace pfdm {

/// `axis`: of the load. A chart for the debonding angle and one for each kind of energy that the experiment names.
/// Throws InputError for a surface that the record does not have.
std::vector<PageBlock> side_by_side_charts(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                                           const std::vector<ColumnRecord>& records, const Vector& axis);

/// Their differences and the force's, `component` of it; nothing where the experiment names none of these. Throws
/// InputError like pfdm compare.
std::optional<Table> side_by_side_table(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                                        int component, const std::vector<ColumnRecord>& records, const Vector& axis);

}  // namespace pfdm
