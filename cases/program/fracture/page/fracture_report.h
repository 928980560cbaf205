#pragma once
// The page of pfdm report for a case of kind "fracture".

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Of the results in a directory, of a run, also an unfinished one, of a fit, or of both. Throws InputError if there
/// are none, or if they belong to another case.
ReportPage fracture_page(const FractureCase& fracture, const std::optional<ExperimentSettings>& experiment,
                         const std::string& name, const std::string& hash, const std::filesystem::path& results);

/// Of a run that goes on, of its curve so far alone: no file is read.
ReportPage running_page(const FractureCase& fracture, const std::optional<ExperimentSettings>& experiment,
                        const std::string& title, std::vector<CurveRow> curve);

}  // namespace pfdm
