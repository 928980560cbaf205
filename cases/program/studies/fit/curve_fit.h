#pragma once
// pfdm fit of cases whose runs leave a curve: the values of the case with which its curve meets the measured ones.

#include "cases/program/session/session.h"
#include "cases/program/studies/fit/curve_fit_case.h"
#include "cases/program/studies/fit/curve_model.h"
#include "postproc/curves/curve_events.h"
#include "postproc/curves/measured_curve.h"
#include "postproc/displacements/displacement_field.h"

#include <functional>
#include <string>
#include <vector>

namespace pfdm {

/// Traction [Pa] over separation [m] of an interface in opening.
struct LawOfCase {
  std::string name;                          ///< of the interface
  double end = 0.0;                          ///< where hardly anything is left of it [m]
  std::function<double(double)> traction{};  ///< at a separation
};

struct CurveFitJob {
  const CaseFile& file;
  const CurveFitSettings& settings;
  const std::vector<MeasuredCurve>& specimens;
  const std::vector<MeasuredEvent>& events;  ///< of the specimens' curves
  const MeasuredFields& fields;              ///< on the specimens
  double straight_from, straight_to;         ///< displacements between which the curves should be straight [m]
  /// What the set-up adds to each specimen's curve, as a case says.
  std::function<std::vector<SetUp>(const CaseFile&)> set_ups;
  CurveModel::ReadCurve read_curve;
  CurveModel::ReadHistory read_history{};  ///< of fits of fields
  /// Of a case's interfaces whose law is the same everywhere; none without such.
  std::function<std::vector<LawOfCase>(const CaseFile&)> laws;
  std::vector<CaseVariant> other_laws;  ///< that are tried where the residuals are more than noise
  std::string name;
  std::string hash;
  std::string title;
};

/// Throws InputError if an event of the specimens' curves lies in no stage.
void require_in_a_stage(const CurveFitSettings& settings, const std::vector<MeasuredCurve>& specimens,
                        const std::vector<MeasuredEvent>& events);

/// Writes fit.json, fit_curve.csv, with a posterior fit_posterior.csv and fit_law_N.csv, and case.fitted.toml to
/// session.results, the runs to runs/ there. Killed at any moment it continues, at the next call, with the runs that it
/// left, to the same result. Throws InputError as require_in_a_stage, and for a start beyond the bounds.
void fit_curve(const CurveFitJob& job, Session& session);

}  // namespace pfdm
