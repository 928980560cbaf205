#pragma once
// The page of pfdm report for a case of kind "homogenize".

#include "postproc/page/report_page.h"

#include <filesystem>
#include <string>

namespace pfdm {

/// Throws InputError if there are no results, or if they belong to another case.
ReportPage homogenization_page(const std::string& title, const std::string& name, const std::string& hash,
                               const std::filesystem::path& results);

/// In a sentence how stiff the composite of these results is. Throws likewise.
std::string headline_of_composite(const std::filesystem::path& results);

}  // namespace pfdm
