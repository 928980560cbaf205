#pragma once
// How far the surfaces of particles have debonded, as charts of a report's page.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "postproc/cohesive/column_record.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/page/report_page.h"

#include <span>
#include <vector>

namespace pfdm {

/// Angles of the debonded caps about both poles of a surface against the displacement; `axis` is that of the load.
/// Beside them what was measured, all of it at one pole, whose computed curve comes first.
Chart debonding_chart(const ColumnRecord& record, const Vector& axis, const std::vector<CurveRow>& curve,
                      std::span<const MeasuredAngle> measured);

/// Of each curved surface of the record but that whose angles the experiment names.
std::vector<PageBlock> debonding_charts(const FractureCase& fracture,
                                        const std::optional<ExperimentSettings>& experiment,
                                        const std::vector<CurveRow>& curve, const std::vector<ColumnRecord>& records);

}  // namespace pfdm
