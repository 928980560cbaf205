#pragma once
// pfdm sensitivity: which parameter of a case moves which part of its curve.

#include "cases/program/input/case_files/case_parameter.h"
#include "cases/program/session/session.h"
#include "cases/program/studies/sensitivity/direct_sensitivity.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// The curve of a run along the way that it moves first.
struct ForwardCurve {
  SampledCurve curve{};
  bool is_turned = false;    ///< displacements and forces have the other sign in the run
  std::size_t n_behind = 0;  ///< rows that fell back behind the largest displacement before them, and are left out
};

struct SensitivityJob {
  using ReadForward = std::function<ForwardCurve(const std::filesystem::path& results)>;
  CaseFile file;
  std::vector<CaseParameter> fitted{};  ///< by which the curve is differentiated if none are named; none: all constants
  std::vector<std::string> left_out{};  ///< keys of the fit that are not positive, or of [experiment]
  ReadForward read_curve;
  /// Runs the case once with derivatives.
  std::function<DirectSensitivity(std::span<const CaseParameter> parameters, Session& session)> direct;
  std::string name, title, hash;  ///< of the case
};

/// Runs the case with each parameter a little larger and smaller, by two steps, side by side, or by choice once with
/// derivatives. Says the elasticities, writes them to session.results, and their page to sensitivity/ there. The runs
/// of differences are kept in runs/, which fits and sweeps use as well: killed at any moment it goes on at the next
/// call. Throws InputError for parameters that are none, and for a curve of fewer than three rows; ComputationError if
/// the case itself does not come to its end.
void run_sensitivity(const SensitivityJob& job, Session& session);

}  // namespace pfdm
