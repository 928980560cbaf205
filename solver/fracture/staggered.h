#pragma once
// Alternate minimisation of one load step: equilibrium at fixed damage, damage at fixed displacement, until neither
// the damage nor the energy changes (Bourdin, Francfort, Marigo, J. Mech. Phys. Solids 48 (2000) 797).

#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/cell_temperature.h"
#include "solver/fracture/cells/strength_drive.h"
#include "solver/fracture/damage/body_fatigue.h"
#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/equilibrium/cohesive_newton.h"
#include "solver/fracture/equilibrium/cohesive_path.h"
#include "solver/fracture/equilibrium/coupled_newton.h"
#include "solver/fracture/equilibrium/load_work.h"
#include "solver/fracture/equilibrium/relaxation.h"
#include "solver/fracture/equilibrium/step_outcome.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/iteration_report.h"
#include "solver/fracture/model/state.h"
#include "solver/fracture/stage_clock.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace pfdm {

class Staggered {
 public:
  Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns, const StaggeredSettings& settings);

  /// Brings `state`, whose load is the step's, to equilibrium. The damage of `start` is the lower bound
  /// (irreversibility). The step is abandoned once a limit on damage or energy release is exceeded. With a limit on the
  /// dissipation (dissipation control) the load is lowered until the step satisfies it: boundary values must then be
  /// proportional to the load parameter, and irreversibility be by bounds.
  StepOutcome solve_step(const FractureState& start, FractureState& state, const StepLimits& limits = {},
                         const IterationWatch& watch = {});

  /// Elastic and surface energy [J], less the potential of tractions, with the displacements that balance the state's
  /// damage at its load and the split as it is there. `has_reduced_energy` says whether there is nothing besides: no
  /// cohesive faces, histories of materials, finite strain, a viscosity or a strength model.
  double reduced_energy(FractureState state);
  bool has_reduced_energy() const;

  const Mesh& mesh() const { return mesh_; }
  /// With the tolerance of the last step.
  const StaggeredSettings& settings() const { return settings_; }
  const FractureModel& model() const { return model_; }
  MomentumSolver& momentum() { return momentum_; }
  const MomentumOperator& balance() const { return momentum_.balance(); }
  DamageEquation& damage_equation() { return damage_; }
  const DamageEquation& damage_equation() const { return damage_; }
  const CellStiffness& stiffness() const { return *stiffness_; }
  const CellTemperature& temperature() const { return temperature_; }
  const CohesiveFaces& faces() const { return faces_; }
  const BodyFatigue& fatigue() const { return *fatigue_; }
  /// Jumps over so many cycles of the load, with what that dissipates.
  void jump(double cycles, FractureState& state);
  StageClock& clock() { return clock_; }
  /// Surface energy of a state [J], all that f Gc dgamma has dissipated, and per volume of the cells [J/m^3]; with the
  /// deferred flux of the last solution, or `renewed` with that of the state's damage.
  double surface_energy(const FractureState& state);
  double renewed_surface_energy(const FractureState& state);
  CellField<double> surface_energy_density(const FractureState& state);
  /// Work of the loads from a state to where they have taken the body [J].
  double work(const FractureState& from, const LoadedBody& to) const {
    return work_of_loads(mesh_, unknowns_, from, to);
  }
  /// Sets the degraded stiffness of the state in the momentum balance, within the step that has begun; or of a state
  /// that is held, after any step.
  void degrade(const FractureState& state);
  void hold(const FractureState& state);

 private:
  struct Loop;
  /// The loop of solve_step; the energies of the outcome are not set.
  StepOutcome alternate(const FractureState& start, FractureState& state, const StepLimits& limits);
  /// What sees the step, its last iteration, when it began, and how long a step has to take before it says so (again).
  struct Telling {
    IterationWatch watch{};
    IterationReport last{};
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
    double after = 0.0;  // [s]
  };
  /// Tells of an iteration; `words` on what holds it up are asked for where the step takes long.
  void tell(IterationReport report, const std::function<std::string()>& words);
  BalanceWatch watch_of_balance(const FractureState& state);
  /// The equilibrium of an accepted state.
  Equilibrium balance_exactly(const FractureState& start, double tightening, FractureState& state);
  /// The tolerances with which the forces on the parts of the body of a converged state balance, by trial; `force`:
  /// through it [N].
  ForceBalance tightened(const FractureState& start, const FractureState& state, double force);
  Equilibrium solve_momentum(const FractureState& start, FractureState& state,
                             const MomentumSolver::Tolerance& tolerance, Index most_newton_steps);
  /// Finds the equilibrium at a load that is no more than that of the path, and lower where the cohesive faces would
  /// dissipate more.
  Equilibrium follow_faces(const FractureState& start, const FacesPath& path,
                           const MomentumSolver::Tolerance& tolerance, FractureState& state);
  struct Energies {
    double stored = 0.0;      // [J]
    double interfaces = 0.0;  // the part of it in cohesive faces [J]
    double torn = 0.0;        // dissipated by these since the start [J]
    double residual = 0.0;    // the part of it that the residual stiffness has [J]
    double unsettled = 0.0;   // error of it by stiffnesses that have not settled [J]
    double force = 0.0;       // through the body, of an accepted state [N]
  };
  /// Updates the driving energy from the equilibrium. With `settles` the stiffness may follow the strain.
  Energies update_driving_energy(const FractureState& start, FractureState& state, bool settles);
  double drive(const FractureState& start, FractureState& state, double scale);
  ResidualShare residual_share(const FractureState& state, const Energies& energies) const;
  /// What a strength model sees of the equilibrium of this state.
  BodyStrength::Seen strength_seen(const FractureState& state);
  FreeStrained free_strained(const FractureState& state);
  bool solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d);
  struct PathLimit {
    double load = 0.0;    // largest load of the step
    double energy = 0.0;  // largest surface energy at the end of the step [J]
    double step = 0.0;    // largest dissipation of the step [J]
  };
  bool follow_path(const FractureState& start, const PathLimit& limit, FractureState& state, CellField<double>& d);

  const Mesh& mesh_;
  const FractureModel& model_;
  const Unknowns& unknowns_;
  const double given_tolerance_;  // of the momentum balance
  StaggeredSettings settings_;    // with the tolerance of this step
  double tightening_ = 1.0;       // of the given one
  MomentumSolver momentum_;
  std::unique_ptr<CellStiffness> stiffness_;
  std::unique_ptr<BodyStrength> strength_;
  CellTemperature temperature_;
  CohesiveFaces faces_;
  DamageEquation damage_;
  std::unique_ptr<BodyFatigue> fatigue_;
  Relaxation::Way way_;
  bool has_newton_;  // the response to which is smooth enough for it
  StageClock clock_;
  Telling telling_;
  CellEnergies of_cells_{};  // of the last equilibrium
};

}  // namespace pfdm
