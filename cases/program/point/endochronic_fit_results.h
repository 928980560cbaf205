#pragma once
// What pfdm fit writes for a case of kind "endochronic": fit.json, a curve for each experiment, case.fitted.toml.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_fit_case.h"
#include "postproc/fits/fit_json.h"

namespace pfdm {

struct FitRun {
  std::string case_name;
  std::string case_hash;
  std::string version;
  double wall_seconds = 0.0;
};

/// What was found, with its verdict. Throws ComputationError where a file cannot be written.
FitFindings write_fit_results(const std::filesystem::path& results, const CaseFile& file, const EndochronicFit& fit,
                              const EndochronicIdentification& found, const FitRun& run);

}  // namespace pfdm
