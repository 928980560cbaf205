#pragma once
// Alternate minimisation of one load step: equilibrium at fixed damage, damage at fixed displacement, until neither
// the damage nor the energy changes (Bourdin, Francfort, Marigo, J. Mech. Phys. Solids 48 (2000) 797). On request the
// loop goes on between its iterations in windows around the cells that still change (window.h).

#include "solver/cell_stiffness.h"
#include "solver/damage_equation.h"
#include "solver/fracture_run.h"
#include "solver/momentum_solver.h"
#include "solver/relaxation.h"
#include "solver/stage_clock.h"

#include <limits>

namespace pfdm {

struct StepOutcome {
  bool converged = false;
  bool failed = false;          ///< given up, as there was no finite solution
  bool broke_too_much = false;  ///< given up, as the damage went beyond what is allowed
  double growth = 0.0;          ///< largest of d over a cell
  double energy_release = 0.0;  ///< change of elastic energy by damage, over elastic and fracture energy before it
  Index iterations = 0;
  double window_iterations = 0.0;  ///< those in windows, each counting as its share of the cells
  Index krylov_iterations = 0;
  double elastic_energy = 0.0;       ///< [J]
  double viscous_dissipation = 0.0;  ///< of the step [J]
  double plastic_dissipation = 0.0;  ///< of the step [J]
};

/// What a step may do at most, and how long it takes.
struct StepLimits {
  double growth = std::numeric_limits<double>::infinity();          ///< of d in a cell
  double energy_release = std::numeric_limits<double>::infinity();  ///< relative
  double dissipation = std::numeric_limits<double>::infinity();     ///< [J]
  double duration = 0.0;    ///< of the step [s]; for models that look at the rate
  bool may_be_cut = false;  ///< a shorter step can be tried instead: one that goes in circles is given up
};

class Staggered {
 public:
  Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns, const StaggeredSettings& settings);

  /// Brings `state`, whose load is the step's, to equilibrium. `start` is the state that damage may not fall below.
  /// Gives up once damage has gone beyond a limit. Where the step would dissipate more than its
  /// limit, the load is lowered until it does not: boundary values must then be proportional to the load parameter, and
  /// damage be bounded by that of `start`.
  StepOutcome solve_step(const FractureState& start, FractureState& state, const RunHooks& hooks,
                         const StepLimits& limits = {});

  /// The loop of solve_step alone; the energies of the outcome are not set.
  StepOutcome alternate(const FractureState& start, FractureState& state, const RunHooks& hooks,
                        const StepLimits& limits);
  /// The driving energy at the displacement of the state, with the stiffness as it is.
  void renew_driving_energy(const FractureState& start, FractureState& state) {
    update_driving_energy(start, state, false);
  }

  MomentumSolver& momentum() { return momentum_; }
  DamageEquation& damage_equation() { return damage_; }
  const DamageEquation& damage_equation() const { return damage_; }
  CellStiffness& stiffness() { return stiffness_; }
  const CellStiffness& stiffness() const { return stiffness_; }
  StageClock& clock() { return clock_; }
  /// Sets the stiffness of the state in the momentum balance.
  void degrade(const FractureState& state);

 private:
  Equilibrium solve_momentum(FractureState& state, const MomentumSolver::Tolerance& tolerance);
  struct Energies {
    double stored = 0.0;     // [J]
    double unsettled = 0.0;  // by which the stiffness that was used falsifies it [J]
  };
  /// May have the stiffness follow the strain.
  Energies update_driving_energy(const FractureState& start, FractureState& state, bool settles);
  void drive(const FractureState& start, FractureState& state, double scale);
  bool solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d);
  /// What the loop came from, and what the damage equation answered to it.
  struct Turn {
    const FractureState& from;
    const CellField<double>& answer;
    double change;  ///< largest of d
  };
  bool settle_windows(const FractureState& start, const Turn& turn, double duration, FractureState& state,
                      StepOutcome& outcome);
  struct PathLimit {
    double load = 0.0;    // most load of the step
    double energy = 0.0;  // surface energy that the step may end with [J], and
    double step = 0.0;    // what it may dissipate [J]
  };
  bool follow_path(const FractureState& start, const PathLimit& limit, FractureState& state, CellField<double>& d);

  const Mesh& mesh_;
  const FractureModel& model_;
  const Unknowns& unknowns_;
  StaggeredSettings settings_;
  MomentumSolver momentum_;
  CellStiffness stiffness_;
  DamageEquation damage_;
  StageClock clock_;
  CellField<Tensor> strain_;             // of the last equilibrium, as are the displacements
  FaceField<Vector> face_displacement_;  // [m]
};

}  // namespace pfdm
