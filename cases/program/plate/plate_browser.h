#pragma once
// What the browser's page of a plate case has beyond the report on paper: headline, steps in time, the body that
// vibrates and gets warm.

#include "cases/program/plate/plate_results.h"
#include "cases/program/session/report_parts.h"

#include <filesystem>

namespace pfdm {

/// Of the results of a run in a directory; only the hash where there is none. Throws InputError for a file of the
/// results that is missing or damaged.
BrowserExtras plate_extras(const PlateProgram& program, const std::filesystem::path& results);

}  // namespace pfdm
