#pragma once
// The page of pfdm report for a case of kind "endochronic".

#include "cases/program/point/endochronic_case.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

/// Of the run and, if there is one, the fit in the results directory. Throws InputError if there is neither, or if they
/// belong to another case.
ReportPage endochronic_page(const EndochronicCase& point, const std::string& name, const std::string& hash,
                            const std::filesystem::path& results);

/// What the run of this case did, in sentences; none without a complete one.
std::vector<std::string> endochronic_headline(const std::string& hash, const std::filesystem::path& results);

}  // namespace pfdm
