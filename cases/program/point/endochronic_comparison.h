#pragma once
// The endochronic law against the experiments that [fit] names: figure 18(b) of AFRL-RW-EG-TR-2016-088.

#include "cases/program/point/endochronic_fit_case.h"
#include "cases/program/session/session.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Strains (or stresses) that were followed, stresses (strains) that were measured and those that the law answers, in
/// columns `answer`_stress_xx_Pa (`answer`_strain_xx) ... Throws ComputationError where the law cannot follow.
CsvTable answered_curve(const MaterialExperiment& experiment, const EndochronicLaw& law, const ControlSettings& control,
                        std::string_view answer);

/// Of all experiments, fitted and predicted.
std::vector<ExperimentMisfit> experiment_misfits(const EndochronicFit& fit, const EndochronicLaw& law);

/// pfdm compare: comparison.json with the misfit of each experiment, comparison_NAME.csv with its curves. The case's
/// own law, whatever [fit] would estimate.
void compare_with_experiments(const EndochronicFit& fit, const EndochronicLaw& law, const std::string& case_name,
                              const std::string& case_hash, Session& session);

}  // namespace pfdm
