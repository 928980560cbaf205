#pragma once
// What the browser's page of a fracture run has beyond the report on paper: headline, steps, the body that moves.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/report_parts.h"

#include <filesystem>
#include <optional>
#include <string>

namespace pfdm {

/// Of the results of a run in a directory; only the hash where there is none. Throws InputError like fracture_page().
BrowserExtras fracture_extras(const FractureCase& fracture, const std::optional<ExperimentSettings>& experiment,
                              const CaseFile& file, const std::string& hash, const std::filesystem::path& results);

}  // namespace pfdm
