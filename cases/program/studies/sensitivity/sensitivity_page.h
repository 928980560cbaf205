#pragma once
// The page of pfdm sensitivity: the curve, elasticities over the displacement below it, and tables.

#include "cases/program/session/session.h"
#include "cases/program/studies/sensitivity/sensitivity_results.h"
#include "postproc/page/report_page.h"

namespace pfdm {

ReportPage sensitivity_page(const CaseSensitivity& found);

/// sensitivity/index.html, report.pdf and report.png in the session's results.
void report_sensitivity(const CaseSensitivity& found, Session& session);

}  // namespace pfdm
