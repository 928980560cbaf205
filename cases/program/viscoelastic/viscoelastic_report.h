#pragma once
// The page of pfdm report for a case of kind "viscoelastic".

#include "cases/program/viscoelastic/viscoelastic_case.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

/// Of the run and, if there is one, the fit in the results directory. Throws InputError if there is neither, or if they
/// belong to another case.
ReportPage viscoelastic_page(const ViscoelasticCase& c, const std::string& name, const std::string& hash,
                             const std::filesystem::path& results);

/// What the run of this case found, in sentences; none without one.
std::vector<std::string> viscoelastic_headline(const std::string& hash, const std::filesystem::path& results);

}  // namespace pfdm
