#include "solver/fracture/fracture_run.h"

#include "mesh/geometry.h"
#include "physics/error.h"
#include "solver/fracture/body_heat.h"
#include "solver/fracture/combinations.h"
#include "solver/fracture/damage/fatigue_cells.h"
#include "solver/fracture/damage/residual_stiffness.h"
#include "solver/fracture/finite_stop.h"
#include "solver/fracture/increments.h"
#include "solver/fracture/model/held_interfaces.h"
#include "solver/fracture/rate_resolution.h"
#include "solver/fracture/spread_damage.h"
#include "solver/fracture/staggered.h"
#include "solver/fracture/unbalanced_force.h"
#include "solver/fracture/unconverged.h"
#include "solver/momentum/body/rigid_motion.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

/// An increment that was tried.
struct Trial {
  FractureState state;
  StepOutcome outcome;
  double increment = 0.0;  // of the load, before dissipation control lowered it
};

}  // namespace

struct FractureRun::Parts {
  std::unique_ptr<const Mesh> own;  // null if the mesh is another's
  const Mesh& mesh;
  FractureModel model;
  LoadingSettings loading;
  Unknowns unknowns;
  std::vector<Index> sides;  // of a box that moves by its mean strain
  Staggered staggered;
  ResidualStiffness residual_stiffness;
  SpreadDamage spread_damage;
  RateResolution rate_resolution;
  FatigueWork fatigue_work;
  UnbalancedForce unbalanced_force;
  std::unique_ptr<BodyHeat> heat;
  Index krylov_iterations = 0, staggered_iterations = 0;

  Parts(std::unique_ptr<const Mesh> given_away, FractureModel fm, const StaggeredSettings& given, LoadingSettings l)
      : Parts(*given_away, std::move(fm), given, std::move(l)) {
    own = std::move(given_away);
  }
  Parts(const Mesh& m, FractureModel fm, const StaggeredSettings& given, LoadingSettings l)
      : mesh(m),
        model(std::move(fm)),
        loading(std::move(l)),
        unknowns((require_complete(m, model), place_unknowns(m, elastic_body(model)))),
        sides(faces_of_sides(model.motion)),
        staggered(m, model, unknowns, given),
        residual_stiffness(model.residual_stiffness, loading.is_proportional && !model.has_cycles()),
        heat((require_combination(mesh, model, unknowns, loading), make_body_heat(m, model, unknowns.plane_normal))) {
    relax_initial_damage();
  }

  // Cracks begin with the optimal profile: the cells given as broken would have several times its energy.
  void relax_initial_damage() {
    if (model.initial_damage.size() == 0) return;
    model.initial_damage = staggered.damage_equation().relaxed(model.initial_damage);
    require_held(mesh, unknowns, model.initial_damage);
  }

  // At given damage and with boundary values that are, displacements are proportional to the load.
  bool is_proportional() const {
    return !staggered.stiffness().has_histories() && !model.is_finite_strain() && loading.is_proportional;
  }

  bool follows_faces() const { return !model.interfaces.empty() && loading.controls_dissipation(); }

  double next_stop(double load) const {
    return staggered.fatigue().next_stop(load, std::min(next_frame(loading, load), heat->end_of_cycle(load)));
  }

  // held: the last load with equilibrium; load: one at which only the residual stiffness carries the tractions.
  [[noreturn]] void fail_torn(double held, double load) const {
    throw NoConvergence(torn_words(held, load, loading, model.is_finite_strain()));
  }

  Remedies remedies(double load) const {
    return remedies_of(mesh, model, unknowns, loading, staggered.balance().traction_forces(load));
  }

  [[noreturn]] void fail_unconverged(const FractureState& trial, const StepOutcome& outcome) {
    const std::string words =
        model.is_finite_strain()
            ? finite_stop(mesh, model, staggered.settings(), staggered.momentum().balance(), trial.damage, outcome)
            : first_change(mesh, staggered.settings(), outcome) + "; " +
                  what_to_try(staggered.settings(), outcome, remedies(trial.load));
    throw NoConvergence(
        fmt::format("step {} at load {:.6g} did not converge with loading.minimum_increment = {:.3g}: {}", trial.step,
                    trial.load, loading.minimum_increment, words));
  }

  Trial attempt(const FractureState& state, double planned, const ForceBalance& balance, const IterationWatch& watch) {
    const double stop = next_stop(state.load);
    Trial trial{.state = state, .outcome = {}};
    trial.state.step = state.step + 1;
    trial.state.balance = balance;
    trial.state.load = state.load + planned > stop - load_rounding ? stop : state.load + planned;
    trial.increment = trial.state.load - state.load;
    heat->begin(trial.state.heat);
    if (state.load > 0.0 && is_proportional() && !follows_faces())
      for (Vector& u : trial.state.displacement) u *= trial.state.load / state.load;
    trial.outcome = staggered.solve_step(state, trial.state, step_limits(loading, trial.increment, planned), watch);
    krylov_iterations += trial.outcome.krylov_iterations;
    staggered_iterations += trial.outcome.iterations;
    return trial;
  }

  StepReport accept(Trial trial, double planned, std::vector<std::string> remarks, FractureState& state) {
    FractureState& next = trial.state;
    const StepOutcome& outcome = trial.outcome;
    const double increment = next.load - state.load;
    next.boundary_force = staggered.momentum().balance().boundary_forces(next.displacement);
    next.balance = outcome.balance;
    next.energy = outcome.energy;
    next.energy.fracture = staggered.surface_energy(next);
    next.energy.external_work =
        state.energy.external_work + staggered.work(state, {next.load, next.boundary_force, next.displacement});
    next.energy.eigenstrain_work += state.energy.eigenstrain_work;
    for (const EnergyEntry& entry : energy_entries)
      if (entry.role == EnergyEntry::Role::dissipated) next.energy.*entry.value += state.energy.*entry.value;
    heat->advance(staggered, state, increment * loading.duration, next);
    staggered.fatigue().end_cycle(next.load, next.fatigue);
    next.increment = next_increment(loading, staggered.settings(), planned, outcome);
    const bool follows_path = loading.controls_dissipation();
    const std::string unstable = follows_path ? "" : spread_damage.remark(state, next, staggered);
    const std::string unresolved = rate_resolution.remark(model, state.interfaces, next.interfaces, next.load);
    state = std::move(next);
    const double work = model.has_cycles() ? 0.0 : supplied(state.energy);  // of cycles it is mostly dissipated
    const std::string residual =
        residual_stiffness.remark(outcome.share, std::max(outcome.starting_energy, work), state.load);
    for (const std::string& remark : {unstable, unresolved, residual, staggered.fatigue().remark(fatigue_work, state)})
      if (!remark.empty()) remarks.push_back(remark);
    StepReport result = report(state, outcome, increment);
    if (!model.motion.any() && !model.has_body_force())
      if (const std::string remark =
              unbalanced_force.remark(unknowns, state.boundary_force, state.load, state.balance.greatest_force);
          !remark.empty())
        remarks.push_back(remark);
    result.remarks = std::move(remarks);
    return result;
  }

  StepReport report(const FractureState& state, const StepOutcome& outcome, double increment) {
    StepReport r;
    r.step = state.step;
    r.load = state.load;
    r.reaction = sums_by_patch(mesh, state.boundary_force);
    r.patch_displacement = staggered.momentum().balance().patch_displacements(state.displacement);
    r.energy = state.energy;
    if (model.motion.any()) r.means = box_means(mesh, unknowns, sides, state.boundary_force, state.displacement);
    r.debonded_area =
        staggered.faces().debonded_areas(staggered.momentum().balance(), state.displacement, state.interfaces);
    const CellField<double> damage = staggered.damage_equation().stiffness_damage().of(state.damage);
    r.heat = heat->report(state.heat);
    r.fatigue = staggered.fatigue().report(state);
    r.max_damage = parallel_max(mesh.n_cells(), [&](Index c) { return damage[c]; });
    r.damaged_volume =
        parallel_sum(mesh.n_cells(), [&](Index c) { return damage[c] > 0.5 ? mesh.cell_volume[c] : 0.0; });
    r.staggered_iterations = outcome.iterations;
    r.krylov_iterations = outcome.krylov_iterations;
    r.increment = increment;
    return r;
  }
};

FractureRun::FractureRun(const Mesh& mesh, FractureModel model, StaggeredSettings staggered, LoadingSettings loading)
    : parts_(std::make_unique<Parts>(mesh, std::move(model), staggered, std::move(loading))) {}

FractureRun::FractureRun(Mesh&& mesh, FractureModel model, StaggeredSettings staggered, LoadingSettings loading)
    : parts_(std::make_unique<Parts>(std::make_unique<const Mesh>(std::move(mesh)), std::move(model), staggered,
                                     std::move(loading))) {}

FractureRun::~FractureRun() = default;

FractureState FractureRun::initial_state() const {
  const std::size_t n = parts_->mesh.n_cells();
  FractureState state;
  state.increment = parts_->loading.initial_increment;
  state.displacement.assign(parts_->unknowns.n_unknowns(), Vector::Zero());
  state.damage = parts_->model.initial_damage.size() > 0 ? parts_->model.initial_damage : CellField<double>(n, 0.0);
  state.driving_energy = CellField<double>(n, 0.0);
  state.closure = CellField<double>(n, 0.0);
  state.histories = parts_->staggered.stiffness().virgin_histories();
  state.interfaces = parts_->staggered.faces().virgin_histories();
  state.boundary_force.assign(parts_->mesh.n_faces() - parts_->mesh.n_interior_faces(), Vector::Zero());
  state.heat = parts_->heat->start(parts_->loading.duration);
  state.fatigue = parts_->staggered.fatigue().virgin();
  return state;
}

bool FractureRun::is_complete(const FractureState& state) const {
  return state.load >= parts_->loading.end - load_rounding || parts_->heat->is_complete(state.heat);
}

StepReport FractureRun::report_of(const FractureState& start) {
  StepReport report = parts_->report(start, {}, 0.0);
  report.energy.fracture = parts_->staggered.renewed_surface_energy(start);
  return report;
}

StepReport FractureRun::step(FractureState& state, const IterationWatch& watch) {
  const double stop = next_frame(parts_->loading, state.load);
  if (const double n = parts_->staggered.fatigue().cycles_to_jump(state, stop); n > 0.0) {
    FractureState beyond = state;
    parts_->staggered.jump(n, beyond);
    StepReport report = step(beyond, watch);
    state = std::move(beyond);
    return report;
  }
  std::vector<std::string> remarks;
  double planned = state.increment;
  ForceBalance balance = state.balance;
  for (;;) {
    Trial trial = parts_->attempt(state, planned, balance, watch);
    const StepOutcome& outcome = trial.outcome;
    if (const auto other = other_tolerances(outcome, balance, state.balance)) {
      balance = *other;
      continue;
    }
    if (outcome.collapsed) parts_->fail_torn(state.load, trial.state.load);
    if (outcome.converged) return parts_->accept(std::move(trial), planned, std::move(remarks), state);
    if (outcome.broke_too_much) {
      planned = std::max(increment_cut * trial.increment, parts_->loading.finest_increment);
      continue;
    }
    planned = increment_cut * trial.increment;
    if (planned < parts_->loading.minimum_increment) parts_->fail_unconverged(trial.state, outcome);
    remarks.push_back(fmt::format("step {} at load {:.6g} did not converge: {}; the increment is cut to {:.3g}",
                                  trial.state.step, trial.state.load,
                                  what_changes(parts_->mesh, parts_->staggered.settings(), outcome), planned));
  }
}

OutputFields FractureRun::output(const FractureState& state) {
  Staggered& staggered = parts_->staggered;
  staggered.hold(state);
  const CellMechanics mechanics = staggered.momentum().balance().mechanics(state.displacement);
  const Mesh& mesh = parts_->mesh;
  CellField<double> density(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c)
    density[c] = staggered.stiffness().stored_energy(c, mechanics, state) / mesh.cell_volume[c];
  OutputFields fields{.displacement = CellField<Vector>(
                          std::vector<Vector>(state.displacement.begin(), state.displacement.begin() + mesh.n_cells())),
                      .damage = staggered.damage_equation().stiffness_damage().of(state.damage),
                      .stress = mechanics.stress,
                      .strain = mechanics.strain,
                      .gradient = mechanics.gradient,
                      .energy_density = density,
                      .driving_energy = state.driving_energy,
                      .fracture_energy_density = staggered.surface_energy_density(state),
                      .traction = staggered.momentum().balance().tractions(state.displacement)};
  staggered.stiffness().show(mechanics, state, parts_->unknowns.plane_normal, fields);
  if (parts_->unknowns.plane_stress) fields.plane_stress_normal = parts_->unknowns.plane_normal;
  fields.interfaces = staggered.faces().output(staggered.momentum().balance(), state);
  fields.history = staggered.stiffness().output(state.histories);
  parts_->heat->show(state.heat, fields.history);
  staggered.fatigue().show(state.fatigue, fields.history);
  return fields;
}

std::vector<HeatRow> FractureRun::warm_by_cycles(const FractureState& state, double time, Index n,
                                                 CellField<double>& rise) {
  return parts_->heat->warm_by_cycles(state.heat, time, n, rise);
}

std::vector<std::string> FractureRun::interface_warnings() const {
  std::vector<std::string> lines = parts_->staggered.faces().warnings();
  for (std::string& line : held_interface_warnings(parts_->mesh, parts_->model)) lines.push_back(std::move(line));
  return lines;
}

const FractureModel& FractureRun::model() const { return parts_->model; }

Index FractureRun::n_unknowns() const { return 2 * parts_->unknowns.n_nodes() + parts_->unknowns.n_unknowns(); }

std::map<std::string, double> FractureRun::cpu_seconds_by_stage() const { return parts_->staggered.clock().seconds(); }

Index FractureRun::krylov_iterations() const { return parts_->krylov_iterations; }

Index FractureRun::staggered_iterations() const { return parts_->staggered_iterations; }

}  // namespace pfdm
