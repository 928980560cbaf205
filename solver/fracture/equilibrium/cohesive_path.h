#pragma once
// Path-following for cohesive faces: the load is an unknown, the energy that a step dissipates is given.

#include "solver/fracture/equilibrium/cohesive_faces.h"

namespace pfdm {

/// Equilibrium with the laws of the faces where a step may dissipate no more than a given energy. The load is an
/// unknown then, at most `most_load`, and falls below that of the step before where the body snaps back. Each iteration
/// solves the linearised equations at two loads; between and beyond them the solution is linear. The next iterate is
/// where on that line the faces dissipate what they may (dissipation as the control: Gutierrez, Commun. Numer. Meth.
/// Engng 20 (2004) 19). Boundary values have to be proportional to the load.
struct FacesPath {
  double most_load;
  double dissipation;  // [J]
};
Equilibrium follow_with_faces(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before,
                              const FacesPath& path, const MomentumSolver::Tolerance& tolerance,
                              MomentumSolver& momentum, double& load, std::vector<Vector>& u);

}  // namespace pfdm
