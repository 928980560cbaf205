#pragma once
// A load step of the staggered scheme: its limits, and what came of it.

#include "physics/tensor.h"
#include "solver/fracture/damage/residual_stiffness.h"
#include "solver/fracture/model/state.h"

#include <limits>
#include <vector>

namespace pfdm {

/// Changes by the last iteration of a step.
struct Restless {
  Index cell = 0;               ///< the one whose damage changed most
  double damage = 0.0;          ///< by this
  double energy = 0.0;          ///< the energy, relative
  double stiffness = 0.0;       ///< error of stiffnesses that follow the strain, in energy over what the body stores
  std::vector<Index> moving{};  ///< broken cells whose cracks have opened or closed
};

struct StepOutcome {
  bool converged = false;
  bool failed = false;          ///< abandoned: no finite solution
  bool stuck = false;           ///< and the reason is that the linear solver came no closer to balance
  bool broke_too_much = false;  ///< abandoned: a limit on damage or energy was exceeded
  double growth = 0.0;          ///< largest increase of d in a cell
  double energy_release = 0.0;  ///< change of elastic energy by damage, over elastic and fracture energy before it
  Index iterations = 0;
  Index krylov_iterations = 0;
  bool collapsed = false;  ///< abandoned: only the residual stiffness carries the loads
  bool settled = false;    ///< all criteria hold but that of the momentum balance
  bool circles = false;    ///< not converged: the iteration had a limit cycle
  Restless rest{};
  double residual = 0.0;         ///< of the momentum balance, relative
  EnergyAccount energy{};        ///< elastic at the end, dissipated within the step
  double starting_energy = 0.0;  ///< elastic, at the load of the step with the damage that it began with [J]
  ResidualShare share{};         ///< of the residual stiffness
  ForceBalance balance{};        ///< with tolerances that the step should have had
};

/// Limits of a step, and its duration.
struct StepLimits {
  double growth = std::numeric_limits<double>::infinity();          ///< of d in a cell
  double energy_release = std::numeric_limits<double>::infinity();  ///< relative
  double dissipation = std::numeric_limits<double>::infinity();     ///< [J]
  double duration = 0.0;                                            ///< of the step [s]; for rate-dependent models
  bool may_be_cut = false;  ///< a shorter step can be tried instead: a limit cycle ends the step at once
};

}  // namespace pfdm
