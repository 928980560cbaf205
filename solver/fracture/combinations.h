#pragma once
// Allowed combinations of models in a fracture run. Each check throws InputError that says which model excludes which.

#include "solver/fracture/fracture_run.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/body/unknowns.h"

#include <string>

namespace pfdm {

/// Every region of the mesh has what the model needs of it; all are of small strain, or all of finite strain.
void require_complete(const Mesh& mesh, const FractureModel& model);

/// Models that stiffness by the mean damage (StiffnessBy::mean) cannot be combined with; empty: none of this model's.
std::string what_excludes_mean_damage(const Mesh& mesh, const FractureModel& model);

/// Splits, materials, strength models, interfaces and the way the load is found.
void require_combination(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                         const LoadingSettings& loading);

}  // namespace pfdm
