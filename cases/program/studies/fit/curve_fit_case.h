#pragma once
// Reads [fit] of cases whose runs leave a curve: which values of the case are estimated, and in which stages.

#include "cases/program/input/case_files/case_parameter.h"
#include "solver/calibration/calibration.h"

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct CurveFitParameter {
  CaseParameter in_case;
  FitParameter in_fit;  ///< SI
};

/// Some of the parameters, estimated from a part of the data.
struct CurveFitStage {
  std::string name;
  std::vector<std::size_t> parameters;  ///< numbers
  double from = 0.0, to = 0.0;          ///< displacements between which the data count [m]
  int starts = 1;                       ///< FitSettings::starts
  int screened = 0;                     ///< FitSettings::screened
};

/// What a sound fit has beside the linear intervals; with a discrepancy of the model a questionable one as well.
enum class Intervals { linear, profile, posterior, discrepancy };
inline bool has_posterior(Intervals wanted) {
  return wanted == Intervals::posterior || wanted == Intervals::discrepancy;
}

struct CurveFitSettings {
  std::vector<CurveFitParameter> parameters;
  std::vector<CurveFitStage> stages;  ///< one at least
  FitSettings solver;
  Intervals intervals = Intervals::linear;
  ConfigTable where;  ///< [fit], for messages
};

/// [[fit.parameters]], of any kind of case. Throws InputError that names file and line.
std::vector<CurveFitParameter> read_fit_parameters(const ConfigTable& fit, const CaseFile& file);

/// Nothing if there is no [fit]. Throws InputError that names file and line.
std::optional<CurveFitSettings> read_curve_fit(const CaseFile& file);

/// Throws InputError if the case's own values, from which the fit starts, are not within the bounds. Of no concern to
/// other runs of the case.
void require_start_within_bounds(const ConfigTable& fit, const std::vector<CurveFitParameter>& parameters);

}  // namespace pfdm
