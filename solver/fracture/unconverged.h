#pragma once
// Messages on a step that did not converge, or takes long.

#include "solver/fracture/staggered.h"

#include <string>
#include <vector>

namespace pfdm {

/// The criteria that do not hold, with the cell whose damage changes most: "the damage of cell 12 at (...) m changes by
/// 3e-04 ...".
std::string what_changes(const Mesh& mesh, const StaggeredSettings& settings, const StepOutcome& outcome);

/// The first of them alone, for a message that has to be short.
std::string first_change(const Mesh& mesh, const StaggeredSettings& settings, const StepOutcome& outcome);

/// Linear solves of a balance until now, and its relative residual.
struct BalanceSoFar {
  Index solves = 0;
  double residual = 0.0;
};
/// How far the balance of a step's interfaces is, and the place of the largest unbalanced force: "the balance of the
/// interfaces has a residual of 2e-04 after 300 linear solves ...".
std::string what_is_unbalanced(const Mesh& mesh, const Unknowns& unknowns, const StaggeredSettings& settings,
                               const MomentumSolver& momentum, const FractureState& state, const BalanceSoFar& balance);

/// How far a step is after `seconds`, with the words on what holds it up.
std::string long_step_words(const IterationReport& report, double seconds, const std::string& held_up);

/// The body breaks apart between the loads `held`, with equilibrium, and `load`; and what may help.
std::string torn_words(double held, double load, const LoadingSettings& loading, bool is_finite_strain);

/// Remedies that the case allows, to be tried where the smallest increment does not converge.
struct Remedies {
  bool viscosity = false;
  bool dissipation_control = false;  ///< and something is loaded by tractions, under which cracks may run
};
/// Remedies that this model allows under this loading; `tractions`: the forces of prescribed tractions [N].
Remedies remedies_of(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                     const LoadingSettings& loading, const std::vector<Vector>& tractions);
/// Advice on remedies: "what may help: a viscosity (...), ...".
std::string what_to_try(const StaggeredSettings& settings, const StepOutcome& outcome, const Remedies& remedies);

}  // namespace pfdm
