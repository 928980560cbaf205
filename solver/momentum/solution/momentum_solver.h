#pragma once
// Equilibrium at fixed damage: flexible GMRES on the traction operator, preconditioned by multigrid or Cholesky factors
// of its compact matrix. With pressures it is preconditioned by the block triangle [A B; 0 S], these for A and a
// diagonal for the Schur complement S. Residuals are row-scaled by (tr D / 3)^-1/2: without scaling the stiffest cells
// dominate the norm and broken cells do not contribute.

#include "solver/linear/fgmres.h"
#include "solver/momentum/momentum.h"
#include "solver/momentum/solution/preconditioner.h"
#include "solver/momentum/solution/stale_preconditioner.h"

#include <algorithm>
#include <optional>

namespace pfdm {

class FreeStrainModes;

struct Equilibrium {
  bool converged = false;
  Index iterations = 0;
  double initial_residual = 0.0;  ///< relative to that of the prescribed displacements and tractions alone
  double residual = 0.0;          ///< at the end, relative likewise
  Index newton_steps = 0;         ///< of laws that are linearised
};

class MomentumSolver {
 public:
  /// `linear` null: the automatic choice.
  MomentumSolver(const Mesh& mesh, const Unknowns& unknowns, const LinearSolver* linear = nullptr);
  ~MomentumSolver();
  MomentumSolver(MomentumSolver&&) noexcept;

  /// New secant moduli. The preconditioner is rebuilt when the stiffness factor g of some cell has changed by more than
  /// a factor of 2, or its moduli alone have (a crack that has closed) and the last solve did not converge. The weights
  /// of the gradients are renewed where g has changed by more than a hundredth. Where a `history` is given, its stress
  /// replaces that of the moduli in every cell.
  void set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, HistoryStress history = {});
  /// A stress by the strain, linearised about the displacements u (MomentumOperator::set_law). The next solve rebuilds
  /// the preconditioner if the stiffness of some cell's faces has changed by more than a factor of 2.
  void set_law(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u);
  /// MomentumOperator::set_eigenstrain(): before set_moduli and set_law.
  void set_eigenstrain(std::optional<double> t, const CellField<double>& rise = {}) {
    if (operator_.set_eigenstrain(t, rise)) reference_load_.reset();
  }
  /// Finite strain: the balance is linearised about the displacements u and the load parameter t
  /// (MomentumOperator::set_finite). The next solve rebuilds the preconditioner if the stiffness of some cell's faces
  /// has changed by more than a factor of 2, or has turned.
  void set_finite(const FiniteLawAt& law, const std::vector<GapStress>& gaps, const CellField<double>& g,
                  const std::vector<Vector>& u, double t);
  /// MomentumOperator::own_sides_at_finite_strain().
  std::vector<Index> own_sides_at_finite_strain() { return operator_.own_sides_at_finite_strain(); }
  /// The laws of the split faces about their separations. The preconditioner is rebuilt when a face together with the
  /// cells beside it, whose stiffness is `bond` [Pa/m], has changed its stiffness by more than a factor of 2.
  void set_springs(std::vector<FaceSpring> springs, const std::vector<double>& bond);
  /// Makes the next set_moduli rebuild everything that could differ, so that the results do not depend on earlier
  /// states.
  void start_afresh() { stale_.start_afresh(); }

  /// Iterations of FGMRES after which it begins again.
  Index restart_length() const;
  /// Writes the prescribed values at t into u and solves to a residual of
  /// max(floor, min(ceiling, reduction x initial)).
  struct Tolerance {
    double reduction = 0.0;
    double ceiling = 1e-8;
    double floor = 1e-8;
    Index most_iterations = 2000;  ///< of FGMRES
    bool whole_cycle = true;       ///< in slender bodies at least a cycle of iterations, which may be more
    double good_enough = 0.0;      ///< a residual from which on slow convergence ends the solution

    /// Residual to reach from that at the start.
    double target(double initial) const { return std::max(floor, std::min(ceiling, reduction * initial)); }
  };
  Equilibrium solve(double t, const Tolerance& tolerance, std::vector<Vector>& u);
  /// Forces [N] at the load parameter t that the displacements u do not balance; zero where those are prescribed.
  std::vector<Vector> unbalanced_forces(double t, const std::vector<Vector>& u) const;
  /// z approximates A^-1 r, after a solve with the moduli of now.
  void precondition(const std::vector<Vector>& r, std::vector<Vector>& z);
  const std::vector<double>& row_scale() const { return scale_; }  ///< after a solve
  /// Residual of these displacements, relative as that of a solution. Prescribed values are not compared.
  double residual(double t, const std::vector<Vector>& u);
  /// Forces [N] on the cells, or on all nodes, at every load parameter from now on; empty for none.
  void set_body_force(std::vector<Vector> force);
  /// Forces [N] of the split faces that are there whatever is prescribed, as of Maxwell branches: residuals are
  /// measured against them, too. Empty for none.
  void set_held_forces(std::vector<Vector> forces);

  MomentumOperator& balance() { return operator_; }
  const MomentumOperator& balance() const { return operator_; }
  Index n_nodes() const { return unknowns_.n_nodes(); }
  Index n_preconditioners() const { return n_preconditioners_; }

 private:
  void build_preconditioner();
  bool is_due() const { return stale_.state() == StalePreconditioner::State::due; }
  void add_body_force(std::vector<Vector>& load) const;
  bool has_long_cycles() const;
  std::vector<Vector> load_vector(double t) const;
  double reference_norm(double t, const std::vector<Vector>& load);

  const Unknowns& unknowns_;
  MomentumOperator operator_;
  bool is_slender_ = false;
  std::vector<Vector> body_force_;   // on the cells [N]; may be empty
  std::vector<Vector> held_forces_;  // of the split faces [N]; may be empty
  std::unique_ptr<Preconditioner> preconditioner_;
  std::unique_ptr<FreeStrainModes> strain_modes_;  // null without free strains
  StalePreconditioner stale_;
  std::vector<double> scale_;                // per unknown
  std::vector<double> pressure_compliance_;  // per pressure [m^3/Pa]
  std::vector<Vector> rest_;                 // residual without the forces of the pressures; work space
  std::optional<double> reference_load_;     // load parameter that reference_ belongs to
  double reference_ = 0.0;
  Index n_preconditioners_ = 0;
};

}  // namespace pfdm
