#pragma once
// What heat and temperatures of a body cannot be combined with.

#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/body/unknowns.h"

namespace pfdm {

/// Throws InputError unless time goes on, with a step's heat in it, and each cell conducts.
void require_heat(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading);

/// Throws InputError unless materials whose times shift have a temperature within their law, and what rises by heat
/// expand does not shear across a mesh one cell thick.
void require_temperature(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns);

}  // namespace pfdm
