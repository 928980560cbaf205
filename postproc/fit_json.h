#pragma once
// fit.json: what a fit found, how sure it is, and how it came there.

#include "solver/endochronic_identification.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

struct ExperimentMisfit {
  std::string name;
  std::size_t n_data = 0;
  double rms = 0.0;         ///< of model less measurement [Pa]
  double rms_stress = 0.0;  ///< of the measurement [Pa]
  std::string curve;        ///< file
};

struct FitReport {
  std::string case_name;
  std::string case_hash;
  std::string version;
  std::string method;
  double wall_seconds = 0.0;
  std::vector<FitParameter> parameters;
  FitResult result;
  std::vector<ExperimentMisfit> experiments;
  std::vector<TriedKernel> tried;
  std::vector<StaggeredRound> rounds;
};

/// Written whole or not at all; numbers that are not finite become null. Throws ComputationError.
void write_fit_json(const std::filesystem::path& path, const FitReport& report);

/// What write_fit_json() wrote: names, units, estimates with their intervals, misfits, method and time. Throws
/// InputError that names the file for what is no such fit.
FitReport read_fit_json(const std::filesystem::path& path);

}  // namespace pfdm
