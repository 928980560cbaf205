#pragma once
// What pfdm fit writes for a case of kind "viscoelastic": fit.json, a curve for each test, case.fitted.toml.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_fit_results.h"
#include "cases/program/viscoelastic/viscoelastic_fit_case.h"
#include "postproc/fits/fit_json.h"

namespace pfdm {

/// What was found, with its verdict. Throws ComputationError where a file cannot be written.
FitFindings write_fit_results(const std::filesystem::path& results, const CaseFile& file,
                              const ViscoelasticFitCase& fit, const ViscoelasticIdentification& found,
                              const FitRun& run);

}  // namespace pfdm
