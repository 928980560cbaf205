#pragma once
// The runs of a sweep as the page in the browser shows them: all columns of sweep.csv, and the curve of each run.

#include "cases/program/session/session.h"
#include "postproc/browser/browser_page.h"
#include "postproc/files/csv_table.h"

namespace pfdm {

/// Of the table in sweep.csv of the session's results, and the folders of the runs. A run that is gone, or has no
/// curve, has none.
RunSet sweep_runs(const CsvTable& table, const Session& session);

}  // namespace pfdm
