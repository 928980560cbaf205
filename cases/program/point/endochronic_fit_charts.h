#pragma once
// The fit of a case of kind "endochronic" on its page.

#include "postproc/fits/fit_json.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// A table of the estimates with their intervals.
Table point_estimates(const FitReport& fit);

/// Charts of four experiments at most, by the curves in the results directory.
std::vector<PageRow> endochronic_fit_rows(const FitReport& fit, const std::filesystem::path& results);

}  // namespace pfdm
