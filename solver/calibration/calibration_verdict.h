#pragma once
// Whether a fit can be taken at its word. Every kind of fit describes itself as FitEvidence, and judge() says what
// speaks against it. On data that are what the model says, with independent noise, less than one fit in a hundred is
// called into question.

#include "solver/calibration/calibration.h"
#include "solver/calibration/correlated_errors.h"

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

enum class Verdict {
  sound,         ///< nothing speaks against the estimates and their intervals
  correlated,    ///< sound, with intervals widened for the correlation of the residuals
  discretised,   ///< sound, with intervals of which the error of mesh or steps is the larger part
  questionable,  ///< the estimates are what the data give, but their intervals do not hold: reasons say why
  failed,        ///< there is no fit
};
/// "sound", "sound with correlated residuals", "sound within the error of mesh and steps", "questionable", "failed".
std::string_view name_of(Verdict verdict);
constexpr Verdict worst_sound = Verdict::discretised;
/// Whether the estimates have intervals.
inline bool is_sound(Verdict verdict) { return verdict <= worst_sound; }
/// Throws InputError.
Verdict verdict_named(std::string_view name);

struct Judgement {
  Verdict verdict = Verdict::sound;
  std::vector<std::string> reasons{};  ///< each with its number; none where the verdict is "sound"
  bool model_error = false;            ///< the residuals are more than noise
};

/// Residuals of one record or curve, evenly weighted, in the order of time or displacement.
struct ResidualSeries {
  std::string name;
  std::string along;  ///< "time", "displacement" ...
  std::vector<double> values;
};

struct JudgedEstimate {
  std::string name;
  double value = 0.0;
  double standard_error = 0.0;  ///< infinite if the data do not determine it, NaN if it is not known
  double lower_bound = -std::numeric_limits<double>::infinity();
  double upper_bound = std::numeric_limits<double>::infinity();
  bool at_bound = false;
};

struct FitEvidence {
  bool converged = true;
  std::string message{};  ///< what ended the fit
  double misfit = 0.0;    ///< largest of the data fitted, rms over measured rms: with 0.9 or more there is no fit
  std::vector<ResidualSeries> series{};  ///< empty: residuals of this kind of fit are judged elsewhere
  std::size_t n_elsewhere = 0;           ///< data of the fit whose residuals are judged elsewhere, as those of fields
  bool noise_is_known = false;           ///< and the residuals are divided by its standard deviation
  /// Residuals below are errors of the computation, without noise to hide them.
  double negligible = 0.0;
  std::vector<JudgedEstimate> estimates{};
  /// Their errors where the residuals are correlated; empty: correlated residuals leave no intervals.
  std::vector<CorrelatedError> correlated{};
  std::vector<FitIteration> starts{};  ///< what each start came to, parameters in the order of the estimates
  std::vector<std::string> found{};    ///< reasons that only this kind of fit can know
};

Judgement judge(const FitEvidence& evidence);

/// How far a series is from independent noise of mean zero.
struct Whiteness {
  double neighbours = 0.0;  ///< correlation of neighbours
  /// Standard deviation of its mean over that of independent values (Bartlett's weights), over as many lags as make it
  /// largest: what varies in a shorter time than all lags is correlated too. At least 1.
  double inflation = 1.0;
  double probability = 1.0;  ///< that noise gives as much correlation (Ljung, Box, Biometrika 65 (1978) 297)
  /// That noise gives as large a correlation of neighbours, or as large a sum over all lags by Bartlett's weights; the
  /// less probable, twice. Sees slow noise of a small part that the sum of squares does not.
  double probability_of_sum = 1.0;
};
/// Over up to 20 lags, an eighth of the values at most; fewer than 16 values say nothing.
Whiteness whiteness(const std::vector<double>& values);

/// Coefficients of these columns in the least squares of the values; zero where there are more columns than values.
std::vector<double> explained_by(const std::vector<double>& values, const std::vector<std::vector<double>>& columns);

/// Rms of what least squares by these columns leave of the values.
double rms_left_by(const std::vector<double>& values, const std::vector<std::vector<double>>& columns);

}  // namespace pfdm
