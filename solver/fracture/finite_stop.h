#pragma once
// Message where a step at finite strain does not converge.

#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/staggered.h"
#include "solver/momentum/momentum.h"

#include <string>

namespace pfdm {

/// The residual that is left, the cell that is distorted most among those with a damage of at most 0.3, and what may
/// help in this model. The balance has to be linearised about the last displacements.
std::string finite_stop(const Mesh& mesh, const FractureModel& model, const StaggeredSettings& settings,
                        const MomentumOperator& balance, const CellField<double>& damage, const StepOutcome& outcome);

}  // namespace pfdm
