#pragma once
// One run of a fracture case with the derivatives of its curve.

#include "cases/program/fracture/run/running_case.h"
#include "cases/program/studies/sensitivity/direct_sensitivity.h"

#include <span>
#include <string>

namespace pfdm {

/// Why the case has no direct derivatives, as in "a material with a history"; empty if it has.
std::string refusal_of_derivatives(const FractureProgram& program, const Mesh& mesh);

/// Runs the case, and differentiates each step by each parameter on the mesh of the case. Throws InputError if no
/// parameter can be followed, or the displacement of the curve falls.
DirectSensitivity differentiated_run(const FractureProgram& program, std::span<const CaseParameter> parameters,
                                     FractureRun& run, const Mesh& mesh, Session& session);

}  // namespace pfdm
