#pragma once
// Whether the forces on the parts of a body balance. Residuals of the momentum balance are relative to the forces that
// boundary displacements would take if nothing gave way: where a stiff part is moved and a soft one carries it, these
// are those of the stiff one, and what is small against them need not be small against the forces that act.

#include "solver/momentum/solution/momentum_solver.h"

#include <span>

namespace pfdm {

/// Share of the greatest force by which parts of a body may be out of balance.
constexpr double bearable_imbalance = 1e-3;
/// The smallest relative residual that rounding leaves.
constexpr double least_tolerance = 1e-14;

/// The force that goes through a body [N]: half the sum of those on its surface, or the mean stress on the volume over
/// the longest extent, whichever is more.
double force_through(const Mesh& mesh, std::span<const Vector> on_faces, const CellField<Tensor>& stress);

/// The sum of what is left on the nodes [N] by these displacements: no part of the body is farther out of balance.
double unbalanced_force(const MomentumSolver& momentum, double load, const std::vector<Vector>& displacement);

/// Whether stresses stay where smaller tolerances leave less force, as in what is soft between stiff parts. In a body
/// on which no force acts, as one that warms freely, all stresses are what tolerances leave.
bool any_stress_stays(const CellField<Tensor>& stress, const CellField<Tensor>& with_smaller_tolerances);

/// The factor, a power of ten, by which tolerances have to be smaller for this imbalance to become bearable.
double needed_tightening(double imbalance);

}  // namespace pfdm
