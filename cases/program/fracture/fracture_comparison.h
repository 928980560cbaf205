#pragma once
// pfdm compare: the results of a fracture case against its experiments.

#include "cases/program/fracture/experiment_case.h"
#include "cases/program/fracture/fracture_case.h"
#include "cases/program/session/session.h"
#include "postproc/curves/curve_csv.h"

#include <string>
#include <vector>

namespace pfdm {

/// Force over displacement as a test that is driven by its displacement would show it.
SampledCurve computed_curve(const std::vector<CurveRow>& rows, int component);

/// Reads the results in session.results, writes the comparison beside them and says its figures. Throws InputError
/// where there are no results or nothing can be compared.
void compare_with_experiment(const FractureCase& fracture, const ExperimentSettings& experiment,
                             const std::string& name, const std::string& hash, Session& session);

}  // namespace pfdm
