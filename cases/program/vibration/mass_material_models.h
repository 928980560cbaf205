#pragma once
// Several models of one case beside each other, as fit_models.json has them.

#include "cases/program/vibration/mass_material_identified.h"
#include "cases/program/vibration/mass_material_jobs.h"
#include "postproc/page/report_page.h"
#include "postproc/vibration/vibration_models.h"

#include <filesystem>
#include <string>

namespace pfdm {

FittedModel summary_of(const IdentifiedModel& found);
/// Of a model for which the method found no parameters.
FittedModel not_found(const std::string& structure, const std::string& why);

/// A line for each model, its parameters below.
void say_models(const ModelComparison& comparison, Log& log);

/// case.fitted_NAME.toml in the results.
std::filesystem::path fitted_case_of(const std::filesystem::path& results, const std::string& structure);
/// What an earlier comparison left: its file, and the fitted case of each of its models.
void remove_comparison(const std::filesystem::path& results);

/// The table of the models, and their responses over one record's.
void add_models(ReportPage& page, const ModelComparison& comparison, const VibrationRecord& record,
                const SegmentSettings& segments, const std::filesystem::path& results);

}  // namespace pfdm
