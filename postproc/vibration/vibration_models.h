#pragma once
// fit_models.json: several models of a mass on a sample fitted to the same records, side by side (table 4 of the report
// AFRL-RW-EG-TR-2016-088).

#include "solver/calibration/calibration_verdict.h"
#include "solver/vibration/identification/identification.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace pfdm {

struct FittedModel {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::string structure;
  int kernel_terms = 0;
  Verdict verdict = Verdict::failed;
  std::vector<std::string> reasons{};  ///< why it is not sound
  double misfit = unknown;             ///< mean over the fitted tests, of the response
  double predicted_misfit = unknown;   ///< over the predicted ones; NaN if there are none
  double bic = unknown;                ///< Bayesian information criterion; NaN where the method gives none
  std::vector<Estimate> estimates{};   ///< intervals NaN unless the verdict is sound
  bool is_found() const { return std::isfinite(misfit); }
};

struct ModelComparison {
  std::string case_name;
  std::string case_hash;
  std::string version;
  std::string method;
  std::string chosen;  ///< structure of fit.json and case.fitted.toml
  std::vector<FittedModel> models;
};

/// What has not failed comes before what has; then the least information criterion, or misfit where there is none.
/// `models` is not empty.
std::size_t best_of(const std::vector<FittedModel>& models);

inline constexpr const char* models_file = "fit_models.json";

/// Written whole or not at all; numbers that are not finite become null. Throws ComputationError.
void write_model_comparison(const std::filesystem::path& path, const ModelComparison& comparison);
/// Throws InputError that names the file for what is no such comparison.
ModelComparison read_model_comparison(const std::filesystem::path& path);

}  // namespace pfdm
