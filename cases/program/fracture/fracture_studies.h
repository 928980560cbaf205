#pragma once
// Fits and sensitivities of cases of kind "fracture": how curves, events and fields are read from runs.

#include "cases/program/fracture/run/running_case.h"

namespace pfdm {

/// Estimates the values of [fit] from [experiment], and then reduces the records of a fracture test, if they are ones.
/// Throws InputError without an experiment.
void fit_fracture(const FractureProgram& program, Session& session);

/// Which parameter moves which part of the curve.
void find_sensitivity(const FractureProgram& program, Session& session);

}  // namespace pfdm
