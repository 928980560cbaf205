#pragma once
// The cohesive law that was extracted of a surface, on a report's page.

#include "postproc/cohesive/column_record.h"
#include "postproc/page/report_page.h"

namespace pfdm {

/// Normal traction over normal separation, by polar angle: the law of the largest traction first and with its states,
/// then those that carry half as much at least. Interrupted where the traction falls within a step, since the law
/// between is not known; the separation is then on a logarithmic axis. `axis`: of the load.
Chart law_chart(const ColumnRecord& record, const Vector& axis);

}  // namespace pfdm
