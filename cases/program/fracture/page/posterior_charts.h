#pragma once
// What a report shows of the posterior of a fit.

#include "postproc/fits/fit_json.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// Laws of interfaces with their bands; the discrepancy of the model, where the posterior holds one; the density of
/// each parameter, and the samples of each pair, of up to four of them. Of a fit that has a posterior. Throws
/// InputError for a file of it that is missing or damaged.
std::vector<Chart> posterior_charts(const FitReport& fit, const std::filesystem::path& results);

}  // namespace pfdm
