#pragma once
// The linear system of displacement and damage together at a state (u, d),
//
//   [ A         dA/dd u ] [du]
//   [ g' dE/du  H       ] [dd],
//
// with rows and columns of the cells left out whose damage is held. Its vectors are the displacements, then the
// damages, three to a vector and times the square root of their diagonal, so that both parts of a residual are of the
// energy norm's size. Preconditioner: the damage equation's conjugate gradients, then one cycle of the momentum
// balance's preconditioner with the forces of that dd. The weights of the gradients are taken as constant.

#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/model/state.h"
#include "solver/linear/conjugate_gradients.h"
#include "solver/linear/fgmres.h"
#include "solver/momentum/solution/momentum_solver.h"
#include "solver/momentum/stiffness_coupling.h"

#include <optional>
#include <vector>

namespace pfdm {

class CoupledSystem {
 public:
  /// `part`: the part of the stiffness that damage degrades; empty: the damage of all cells is held. `held`: nonzero in
  /// cells whose damage is. For use while the solvers keep their moduli, after a solution by `momentum` with them.
  CoupledSystem(MomentumSolver& momentum, const DamageEquation& damage, CellField<IsotropicElasticity> part,
                const FractureState& state, ConjugateGradients::Held held);

  std::size_t size() const { return n_u_ + as_size((n_cells_ + 2) / 3); }
  /// The damage of a cell in a vector, times root().
  double& of(std::vector<Vector>& x, Index c) const { return x[n_u_ + as_size(c / 3)][c % 3]; }
  double of(const std::vector<Vector>& x, Index c) const { return x[n_u_ + as_size(c / 3)][c % 3]; }
  bool is_held(Index c) const { return held_[c] != 0; }
  double root(Index c) const { return root_[c]; }  ///< of the diagonal; 1 of cells that cannot be damaged
  Index n_cells() const { return n_cells_; }
  std::size_t n_displacements() const { return n_u_; }
  std::vector<double> scale() const;  ///< of residuals

  void apply(const std::vector<Vector>& x, std::vector<Vector>& y);
  void precondition(const std::vector<Vector>& r, std::vector<Vector>& z);
  /// Improves x until the residual is reduced to this share.
  KrylovResult solve(const std::vector<Vector>& b, double reduction, Index most_iterations, std::vector<Vector>& x);

 private:
  void add_damage(const std::vector<Vector>& x, std::vector<Vector>& y);

  MomentumSolver& momentum_;
  const DamageEquation& damage_;
  std::optional<StiffnessCoupling> coupling_;  // none where all damage is held
  Index n_cells_;
  std::size_t n_u_;
  CellField<double> g_prime_, root_;
  std::vector<double> diagonal_, r_d_, z_d_;
  ConjugateGradients::Held held_;
  ConjugateGradients by_damage_;
  CellField<double> dd_, dg_, energy_, by_mean_;
  std::vector<Vector> u_, force_;
};

}  // namespace pfdm
