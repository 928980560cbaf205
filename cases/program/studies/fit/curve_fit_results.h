#pragma once
// What a fit of a curve leaves: fit.json, fit_curve.csv, case.fitted.toml, and what is said of it.

#include "cases/program/studies/fit/curve_fit.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"

#include <map>
#include <string>
#include <vector>

namespace pfdm {

struct CurveFitFindings {
  std::vector<double> values;    ///< of all parameters [SI]
  std::vector<FitStage> stages;  ///< all of them, in their order
  const std::vector<CaseParameter>& parameters;
  SampledCurve first_curve;  ///< with the case's own values
  SampledCurve fitted_curve;
  std::vector<MeasuredCurve> specimens;  ///< with the set-up as estimated
  RunCounts runs;
  const std::map<std::string, CsvTable>& tables;  ///< by the names of their files
  std::vector<FittedEvent> events;
  std::vector<FittedField> fields;
  std::optional<RunCounts> coarse_runs;  ///< with [fit] `coarse`
  double seconds = 0.0;
};

/// Throws ComputationError.
void write_curve_fit(const CurveFitJob& job, const CurveFitFindings& found, Session& session);

}  // namespace pfdm
