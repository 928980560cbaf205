#pragma once
// fit.json: what a fit found, how sure it is, and how it came there.

#include "solver/point/endochronic_identification.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct ExperimentMisfit {
  std::string name;
  std::size_t n_data = 0;
  double rms = 0.0;                 ///< of model less measurement [unit]
  double rms_measured = 0.0;        ///< [unit]
  std::string curve;                ///< file
  std::string quantity = "stress";  ///< that was measured
  std::string unit = "Pa";
};

/// A part of a fit, with some of the parameters and of the data.
struct FitStageReport {
  std::string name;
  double from = 0.0, to = 0.0;  ///< displacements [m]
  std::vector<FitParameter> parameters;
  double first_rms = 0.0;  ///< of the residuals with the first guess of all parameters
  FitResult result;
};

/// How many runs of the model a fit took.
struct RunCounts {
  int made = 0, reused = 0, failed = 0;
};

struct FitReport {
  std::string case_name;
  std::string case_hash;
  std::string version;
  std::string method;
  double wall_seconds = 0.0;
  std::vector<FitParameter> parameters;
  std::optional<double> first_rms = std::nullopt;  ///< of the residuals with the first guess
  FitResult result;
  std::vector<ExperimentMisfit> experiments;
  std::vector<TriedKernel> tried;
  std::vector<StaggeredRound> rounds;
  std::vector<FitStageReport> stages;  ///< those before the last, which is `result`
  std::optional<RunCounts> runs;
};

/// Written whole or not at all; numbers that are not finite become null. Throws ComputationError.
void write_fit_json(const std::filesystem::path& path, const FitReport& report);

/// What write_fit_json() wrote: names, units, estimates with their intervals, misfits, method and time. Throws
/// InputError that names the file for what is no such fit.
FitReport read_fit_json(const std::filesystem::path& path);

}  // namespace pfdm
