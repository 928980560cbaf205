#pragma once
// Equilibrium with the laws of cohesive faces, by Newton's method. Within each linear solve the laws are linearised
// about the last separation, with the tangent. While that leads astray (a jump) its convex part is taken, in which
// nothing softens. Each such step minimises a majorant of the energy, and faces break on from below until the rest of
// them holds. In between every face is brought into balance with the cells beside it. A converged state does not depend
// on any of this.

#include "solver/fracture/equilibrium/cohesive_faces.h"

#include <functional>

namespace pfdm {

/// Linearises the balance about the u that is solved for; empty at small strain.
using CellLaws = std::function<void()>;

/// Sees an equilibrium that is looked for: linear solves until now, and the residual after the last but one. The
/// balance is linearised about u.
using BalanceWatch = std::function<void(Index solves, double residual)>;

/// Equilibrium with the laws of the faces at the load t: as MomentumSolver::solve, the residual being that with the
/// laws at u. At finite strain a step is halved while a sound cell turns inside out, the residual is infinite if no
/// equilibrium is found, and the balance is left linearised about u. Overstresses by the rate of opening go into
/// `after`.
Equilibrium solve_with_faces(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before, double t,
                             const MomentumSolver::Tolerance& tolerance, const CellLaws& cells,
                             MomentumSolver& momentum, std::vector<Vector>& u, std::vector<InterfaceHistory>& after,
                             const BalanceWatch& watch = {});

}  // namespace pfdm
