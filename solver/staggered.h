#pragma once
// Alternate minimisation of one load step: equilibrium at fixed damage, damage at fixed displacement, until neither
// the damage nor the energy changes (Bourdin, Francfort, Marigo, J. Mech. Phys. Solids 48 (2000) 797).

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
  bool grew_too_much = false;  ///< given up, as the damage went beyond the growth allowed
  double growth = 0.0;         ///< largest of d over a cell
  Index iterations = 0;
  Index krylov_iterations = 0;
  double elastic_energy = 0.0;  ///< [J]
};

class Staggered {
 public:
  Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns, const StaggeredSettings& settings);

  /// Brings `state`, whose load is the step's, to equilibrium. `start` is the state that damage may not fall below.
  /// Gives up once some cell's damage has grown by more than `allowed_growth`.
  StepOutcome solve_step(const FractureState& start, FractureState& state, const RunHooks& hooks,
                         double allowed_growth = std::numeric_limits<double>::infinity());

  MomentumSolver& momentum() { return momentum_; }
  const DamageEquation& damage_equation() const { return damage_; }
  StageClock& clock() { return clock_; }
  /// Sets the stiffness of the state in the momentum balance.
  void degrade(const FractureState& state);

 private:
  Equilibrium solve_momentum(FractureState& state, const MomentumSolver::Tolerance& tolerance);
  struct Energies {
    double elastic = 0.0;    // [J]
    double unsettled = 0.0;  // by which the stiffness that was used falsifies it [J]
  };
  /// May have the stiffness follow the strain.
  Energies update_driving_energy(const FractureState& start, FractureState& state, bool settles);
  bool solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d);

  const Mesh& mesh_;
  const FractureModel& model_;
  StaggeredSettings settings_;
  MomentumSolver momentum_;
  CellStiffness stiffness_;
  DamageEquation damage_;
  StageClock clock_;
};

}  // namespace pfdm
