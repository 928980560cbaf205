#pragma once
// The page of a plate case.

#include "cases/program/plate/plate_results.h"
#include "cases/program/session/session.h"
#include "postproc/page/report_page.h"

namespace pfdm {

/// Throws InputError if there are no results of this case.
ReportPage plate_page(const PlateProgram& program, const Session& session);

}  // namespace pfdm
