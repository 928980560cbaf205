#include "solver/fracture/unconverged.h"

#include "physics/error.h"
#include "solver/fracture/combinations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace pfdm {
namespace {

bool is_allowed(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                const LoadingSettings& loading) {
  try {
    require_combination(mesh, model, unknowns, loading);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

// Stiffnesses that have not settled, as of cracks that close; "" where they have.
std::string what_closes(const Mesh& mesh, const StaggeredSettings& settings, const Restless& rest) {
  std::vector<std::string> left;
  if (!rest.moving.empty()) {
    const Vector& x = mesh.cell_centre[rest.moving.front()];
    left.push_back(
        fmt::format("cracks open or close in {} broken cells, among them cell {} at ({:.4g}, {:.4g}, {:.4g}) m",
                    rest.moving.size(), rest.moving.front(), x[0], x[1], x[2]));
  }
  if (rest.energy + rest.stiffness >= settings.energy_tolerance && rest.stiffness > rest.energy)
    left.push_back(fmt::format(
        "stiffnesses that follow the strain err by {:.1e} of the stored energy (solver.energy_tolerance = {:g})",
        rest.stiffness, settings.energy_tolerance));
  return fmt::format("{}", fmt::join(left, ", "));
}

// At least one.
std::vector<std::string> criteria_left(const Mesh& mesh, const StaggeredSettings& settings,
                                       const StepOutcome& outcome) {
  if (outcome.stuck)
    return {fmt::format("the linear solver came no closer to balance (residual {:.1e})", outcome.residual)};
  if (outcome.failed) return {"no displacements were found that balance the forces"};
  std::vector<std::string> left;
  const Vector& x = mesh.cell_centre[outcome.rest.cell];
  if (outcome.rest.damage >= settings.damage_tolerance && !outcome.settled)
    left.push_back(
        fmt::format("the damage of cell {} at ({:.4g}, {:.4g}, {:.4g}) m changes by {:.1e} an iteration "
                    "(solver.damage_tolerance = {:g})",
                    outcome.rest.cell, x[0], x[1], x[2], outcome.rest.damage, settings.damage_tolerance));
  if (outcome.rest.energy >= settings.energy_tolerance && !outcome.settled)
    left.push_back(fmt::format("the energy changes by {:.1e} of it (solver.energy_tolerance = {:g})",
                               outcome.rest.energy, settings.energy_tolerance));
  if (const std::string cracks = what_closes(mesh, settings, outcome.rest); !cracks.empty() && !outcome.settled)
    left.push_back(cracks);
  if (outcome.residual > settings.equilibrium_tolerance)
    left.push_back(fmt::format("the residual of the momentum balance is {:.1e} (solver.equilibrium_tolerance = {:g})",
                               outcome.residual, settings.equilibrium_tolerance));
  if (left.empty()) left.emplace_back("the last iteration has not settled");
  return left;
}

}  // namespace

std::string what_changes(const Mesh& mesh, const StaggeredSettings& settings, const StepOutcome& outcome) {
  return fmt::format("{}", fmt::join(criteria_left(mesh, settings, outcome), ", "));
}

std::string first_change(const Mesh& mesh, const StaggeredSettings& settings, const StepOutcome& outcome) {
  return criteria_left(mesh, settings, outcome).front();
}

std::string what_is_unbalanced(const Mesh& mesh, const Unknowns& unknowns, const StaggeredSettings& settings,
                               const MomentumSolver& momentum, const FractureState& state,
                               const BalanceSoFar& balance) {
  const std::vector<Vector> rest = momentum.unbalanced_forces(state.load, state.displacement);
  const auto size = [&](Index i) { return rest[i].norm() * momentum.row_scale()[i]; };
  Index node = 0;
  for (Index i = 1; i < unknowns.n_nodes(); ++i)
    if (size(i) > size(node)) node = i;
  const bool is_cell = node < unknowns.n_cells;
  const Vector x = unknowns.place(mesh, node);
  return fmt::format(
      "the balance of the interfaces has a residual of {:.1e} after {} linear solves (solver.equilibrium_tolerance = "
      "{:g}), most in the {} at ({:.4g}, {:.4g}, {:.4g}) m",
      balance.residual, balance.solves, settings.equilibrium_tolerance, is_cell ? "cell" : "face", x[0], x[1], x[2]);
}

std::string long_step_words(const IterationReport& report, double seconds, const std::string& held_up) {
  return fmt::format(
      "step {} at load {:.6g} has taken {:.0f} s so far, {} iterations: {}. What may help: a smaller "
      "loading.maximum_increment, or a larger tolerance where one is named",
      report.step, report.load, seconds, report.iteration, held_up);
}

std::string torn_words(double held, double load, const LoadingSettings& loading, bool is_finite_strain) {
  return fmt::format(
      "the body breaks apart between the loads {:.6g} and {:.6g}: beyond, only the residual stiffness of broken "
      "cells carries its loads. {}; a smaller loading.maximum_increment locates the load more exactly",
      held, load,
      loading.controls_dissipation() ? "No intact ligament carries load any more"
      : is_finite_strain             ? "Prescribe displacements instead"
                         : "Prescribe displacements instead, or use dissipation control (loading.maximum_dissipation)");
}

Remedies remedies_of(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                     const LoadingSettings& loading, const std::vector<Vector>& tractions) {
  Remedies may;
  if (!(model.viscosity > 0.0)) {
    FractureModel viscous = model;
    LoadingSettings timed = loading;
    viscous.viscosity = timed.duration = 1.0;
    may.viscosity = is_allowed(mesh, viscous, unknowns, timed);
  }
  if (loading.controls_dissipation()) return may;
  LoadingSettings controlled = loading;
  controlled.maximum_dissipation = 1.0;
  may.dissipation_control = std::ranges::any_of(tractions, [](const Vector& f) { return !f.isZero(); }) &&
                            is_allowed(mesh, model, unknowns, controlled);
  return may;
}

std::string what_to_try(const StaggeredSettings& settings, const StepOutcome& outcome, const Remedies& remedies) {
  if (outcome.stuck) {
    const bool is_direct = settings.linear != nullptr && settings.linear->name == "direct";
    return fmt::format("may help: {}better cells (pfdm mesh), a larger fracture.residual_stiffness",
                       is_direct ? "" : "solver.linear = \"direct\", ");
  }
  if (outcome.settled)
    return "its damage and energies have converged: a larger solver.equilibrium_tolerance accepts it";
  std::vector<std::string> ways;
  if (outcome.failed) {
    ways.emplace_back("a smaller loading.minimum_increment");
  } else if (!outcome.circles) {
    ways.push_back(fmt::format("solver.maximum_iterations above {}", settings.maximum_iterations));
  } else {
    ways.emplace_back("smaller cells there");
    ways.emplace_back("larger tolerances");
  }
  if (remedies.viscosity) ways.emplace_back("fracture.viscosity");
  if (remedies.dissipation_control) ways.emplace_back("loading.maximum_dissipation");
  return fmt::format("{}may help: {}", outcome.circles ? "more iterations do not help, they go in circles; " : "",
                     fmt::join(ways, ", "));
}

}  // namespace pfdm
