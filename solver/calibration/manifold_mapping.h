#pragma once
// Least squares of an expensive (fine) model by a cheap (coarse) one that resembles it, as the same case on a coarser
// mesh: manifold mapping (Echeverria, Hemker, Comput. Methods Appl. Math. 5 (2005) 107). About the best point p_k so
// far, the coarse residuals c are mapped to the fine ones f,
//
//   r_k(p) = f(p_k) + S_k (c(p) - c(p_k)),   S_k = dF dC^+ + (1 - U_F U_F^T)(1 - U_C U_C^T),
//
// dF and dC being the differences of the residuals at the points that the fine model has been asked at, U the
// orthonormal bases of their columns. The minimum of r_k is the next point. Where no next point is better the fine
// model is asked once more, a standard error away in the direction that the data determine least: its Jacobian is then
// known there, too, and the minimum is the fine model's own.

#include "solver/calibration/calibration.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct CoarseModel {
  /// Residuals at the same data, of the same parameters, as many as the fine model has.
  FitProblem problem;
  /// Told the point p_k about which the residuals are mapped next, before they are asked for: a model may shift itself
  /// to meet the fine one there.
  std::function<void(std::span<const double> parameters)> meet = {};
  /// Its own fit, where that is there already.
  std::optional<FitResult> fitted = std::nullopt;
};

struct MappedFit {
  /// Of the fine model at its minimum, with the derivatives of the mapped one. `evaluations`: of the fine model.
  FitResult result;
  FitProblem mapped;  ///< residuals r_k at the end, by coarse evaluations alone
  /// Why the coarse model does not lead to the minimum of the fine one; empty if it does.
  std::string failure;
  std::vector<double> best;  ///< lowest sum of squares of the fine model; empty if it has converged nowhere
};

/// The starts are those of the coarse model. Throws as fit() does.
MappedFit fit_by_mapping(const FitProblem& fine, const CoarseModel& coarse, const FitSettings& settings);

}  // namespace pfdm
