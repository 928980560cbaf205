#pragma once
// pfdm analyse of a case of kind "mass_material": its records without a fit.

#include "cases/program/vibration/mass_material_jobs.h"
#include "postproc/vibration/analysis_json.h"
#include "solver/vibration/diagnosis/record_analysis.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

/// Folder of the results that has what pfdm analyse writes.
inline constexpr const char* analysis_folder = "analysis";

/// A model whose response is laid over the records: that of the case, and those that pfdm fit has left in the results.
struct NamedModel {
  std::string name;  ///< also of a column: "model_of_the_case", "fitted", "fitted_4b"
  MassMaterial parameters;
};
std::vector<NamedModel> models_at_hand(const MassMaterialCase& c, const std::filesystem::path& results);

/// Of the relative acceleration over the base's: of a sine at its frequency, else of H1 where the coherence is above
/// 0.5.
LargestResponse largest_response(const VibrationRecord& record, const RecordAnalysis& analysis);

/// Spectra, responses, spectrogram, harmonics, envelopes of every record as CSV, and analysis.json.
void analyse_mass_material(const MassMaterialProgram& program, Session& session);

/// What it wrote, of tests that the case no longer has as well.
void remove_analysis(const std::filesystem::path& results);

/// Pages of the tests, report/NAME/report.pdf, if pfdm analyse has been run with this case. Throws InputError where it
/// was another one.
void write_test_pages(const MassMaterialProgram& program, Session& session);

}  // namespace pfdm
