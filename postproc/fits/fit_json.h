#pragma once
// fit.json of every kind of case: what a fit found, how sure it is, and how it came there. What is to be said of all
// fits belongs in FitReport and write_fit_json(); cases/README.md lists the fields.

#include "postproc/fits/fit_findings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// How many runs of the model a fit took.
struct RunCounts {
  int made = 0, reused = 0, failed = 0;
};

/// What only one kind of case tells: an object of fit.json that has its name.
struct OwnFindings {
  std::string kind;         ///< of the case, as in "fracture"
  std::string json = "{}";  ///< text of the object
};

struct FractureFindings {
  std::vector<FitStage> earlier_stages;
  RunCounts runs;
  std::optional<RunCounts> coarse_runs = std::nullopt;  ///< of a coarser case that led the fit
};
OwnFindings own_findings(const FractureFindings& findings);

struct FitReport {
  std::string case_name;
  std::string case_hash;
  std::string version;
  std::string method;
  double wall_seconds = 0.0;
  double confidence = 0.95;  ///< of the intervals
  FitFindings found;
  std::vector<ExperimentMisfit> experiments;
  std::vector<FittedEvent> events{};  ///< in fit.json only where there are any
  std::vector<FittedField> fields{};  ///< likewise
  OwnFindings own;
};

/// Written whole or not at all; numbers that are not finite become null. Throws ComputationError.
void write_fit_json(const std::filesystem::path& path, const FitReport& report);

/// Text of a fit.json of a kind of case with all that may be in one. Lists have one entry, which stands for all; what
/// is empty may hold anything. The values mean nothing.
std::string fit_json_like(const std::string& kind);

/// What reports show of it: parameters, experiments, method and time, and what the kind of case tells of its own.
/// Throws InputError that names the file for what is no such fit, or one of another format.
FitReport read_fit_json(const std::filesystem::path& path);

}  // namespace pfdm
