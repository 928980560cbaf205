#pragma once
// What pfdm report shows of displacement fields that a fit has met.

#include "postproc/fits/fit_json.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// For each field what was measured, computed, and the difference in its last frame, of the component that varies most;
/// then the rms of all frames. Throws InputError for a table of the fit that is missing or damaged.
std::vector<PageRow> field_rows(const FitReport& fit, const std::filesystem::path& results);

}  // namespace pfdm
