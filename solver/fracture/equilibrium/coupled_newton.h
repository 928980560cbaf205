#pragma once
// Newton's method on displacement and damage together, for the iterations in which a crack grows steadily or a step
// settles. In between, jumps are left to the accelerated alternation (composed, as in Farrell, Maurini, IJNME 109
// (2017) 648). Its equations, at a state (u, d) whose answer by the damage equation is known,
//
//   [ A         dA/dd u ] [du]   [ load - A u ]
//   [ g' dE/du  H       ] [dd] = [ -imbalance ]     of the cells that the answer does not put on a bound,
//
// are solved by FGMRES (coupled_system.h). Steps are as long as the largest change of damage that was good
// the last times, and are taken back if they raise the energy. Where the system is indefinite and its solution leads
// uphill, towards an unstable equilibrium, the opposite direction is a descent of negative curvature.

#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <limits>
#include <optional>
#include <utility>

namespace pfdm {

class CoupledNewton {
 public:
  /// Whether it takes less time than the alternation alone: on meshes one cell thick, where the preconditioner is
  /// Cholesky factors and a solution takes some ten iterations of FGMRES (tests/benchmark/log_iterations.md).
  static bool suits(const Mesh& mesh, const Unknowns& unknowns);

  /// Newton's method of one step of loading, with the solvers of the alternation; `part`: the part of the stiffness
  /// that damage degrades.
  CoupledNewton(const Mesh& mesh, const FractureModel& model, CellField<IsotropicElasticity> part,
                MomentumSolver& momentum, const DamageEquation& damage)
      : mesh_(mesh), model_(model), part_(std::move(part)), momentum_(momentum), damage_(damage) {}

  /// An iteration of the alternation, which has left the state in equilibrium.
  struct Iterate {
    double energy = 0.0;             ///< elastic, of fracture and of the tractions, at the state [J]
    const CellField<double>& lower;  ///< bound of the damage
  };
  enum class Moved { no, on, back };
  /// Takes the next step: `on`, and the state is changed; or no step. `back`: the last step had raised the energy; the
  /// state is again that before it, and `answer` is its answer.
  Moved move(const Iterate& at, FractureState& state, CellField<double>& answer);
  Index krylov_iterations() const { return krylov_iterations_; }  ///< of the last move

 private:
  struct Direction {
    std::vector<Vector> u;
    CellField<double> d;
    double slope = 0.0;    // of the energy along it [J]
    double largest = 0.0;  // of d
  };
  struct Base {
    std::vector<Vector> u;
    CellField<double> d, answer;
    Direction direction;
    double energy = 0.0, change = 0.0, share = 0.0;
    int tries = 0;
  };
  Direction solve(const Iterate& at, const FractureState& state, const CellField<double>& answer);
  void go(double share, const CellField<double>& lower, FractureState& state);
  Moved retreat(const Iterate& at, FractureState& state, CellField<double>& answer);

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<IsotropicElasticity> part_;
  MomentumSolver& momentum_;
  const DamageEquation& damage_;
  std::optional<Base> base_;                                        // of the step that is being tried
  double radius_ = 0.2;                                             // largest change of damage of a step
  int wait_ = 0, next_wait_ = 1;                                    // iterations without a step after one that failed
  bool begun_ = false;                                              // the alternation has been slow
  double change_before_ = std::numeric_limits<double>::infinity();  // of damage, by the alternation
  Index krylov_iterations_ = 0;
};

}  // namespace pfdm
