#pragma once
// pfdm sensitivity: which parameter of a case moves which part of its curve.

#include "cases/program/session/session.h"
#include "cases/program/studies/fit/curve_model.h"
#include "cases/program/studies/sensitivity/direct_sensitivity.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct SensitivityJob {
  CaseFile file;
  std::vector<CaseParameter> fitted{};  ///< by which the curve is differentiated if none are named; none: all constants
  CurveModel::ReadCurve read_curve;
  /// Runs the case once with derivatives.
  std::function<DirectSensitivity(std::span<const CaseParameter> parameters, Session& session)> direct;
  std::string name, title, hash;  ///< of the case
};

/// Runs the case with each parameter a little larger and smaller, by two steps, side by side, or by choice once with
/// derivatives; says and writes the elasticities to session.results and their page to sensitivity/ there. The runs of
/// differences are kept in runs/, which fits and
/// sweeps use as well: killed at any moment it goes on at the next call. Throws InputError for parameters that are
/// none, ComputationError if the case itself does not come to its end.
void run_sensitivity(const SensitivityJob& job, Session& session);

}  // namespace pfdm
