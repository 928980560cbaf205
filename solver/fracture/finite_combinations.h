#pragma once
// Allowed combinations with materials of finite strain. Each check throws InputError that says which model excludes
// which.

#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/body/unknowns.h"

namespace pfdm {

/// Materials, splits, interfaces and loads of a body at finite strain: what has not been worked out is refused.
void require_finite(const FractureModel& m, const Unknowns& unknowns, const LoadingSettings& loading);

/// Eigenstrains may not turn cells inside out, F* = 1 + eps* being the free deformation, nor shrink them so far that
/// they count as turned (finite_newton.h).
void require_free_deformation(const Mesh& mesh, const Unknowns& unknowns, const LoadingSettings& loading);

}  // namespace pfdm
