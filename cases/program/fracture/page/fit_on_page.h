#pragma once
// What pfdm report shows of a fit to force-displacement curves.

#include "postproc/fits/fit_json.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// Verdict and estimates with their intervals, of any kind of case.
Table estimates_table(const FitReport& fit);

/// Estimates with their intervals, by profile likelihood too where the fit has them; then the curves, measured, of the
/// first guess and fitted. Throws InputError for a file of the fit that is missing or damaged.
std::vector<PageRow> fit_on_page(const FitReport& fit, const std::filesystem::path& results);

}  // namespace pfdm
