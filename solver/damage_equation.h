#pragma once
// The damage equation at fixed displacement, from the surface energy (Gc/c0) (alpha(d)/ell + ell |grad d|^2):
//
//   (Gc/(c0 ell)) alpha'(d) + (1 - k) g'(d) psi_plus - div((2 Gc ell/c0) grad d) = 0,  lower <= d <= 1,
//
// no flux through the boundary, d = 0 in undamageable regions. With a viscosity eta (Ginzburg-Landau; Miehe,
// Welschinger, Hofacker, Int. J. Numer. Meth. Engng 83 (2010) 1273) the left side has eta (d - d_n)/dt as well.
// Two-point fluxes, in series where Gc or ell jumps, with a deferred correction by two-ring gradients for faces that
// are not orthogonal to their centre line. The correction is limited to the range of the damage around the face; a
// limiter at half of the two-point flux takes the order on tetrahedra from 2 to 0.8. Bounds by a primal-dual active set
// (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13 (2002) 865), linear systems by conjugate gradients.

#include "solver/fracture_model.h"
#include "solver/gradient.h"

#include <cstdint>
#include <vector>

namespace pfdm {

struct DamageSolution {
  Index active_set_iterations = 0;
  Index krylov_iterations = 0;
  bool converged = true;
};

class DamageEquation {
 public:
  /// plane_normal: of one-cell-thick meshes, else zero.
  DamageEquation(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

  struct Tolerance {
    Index corrections = 1;    ///< number of updates of the deferred flux; a staggered loop updates it at each iteration
    double reduction = 1e-9;  ///< of the initial value of the largest step of a cell by itself; 1e-10 at least
  };
  /// Solves for d [-] from its present value, given psi_plus [J/m^3] and the lower bound.
  DamageSolution solve(const CellField<double>& psi_plus, const CellField<double>& lower, const Tolerance& tolerance,
                       CellField<double>& d);

  /// The damage of least surface energy that is nowhere below `given`: the optimal profile about cracks whose cells are
  /// given as broken. Their surface energy is then about Gc times their area, whatever was given beside them.
  CellField<double> relaxed(const CellField<double>& given);

  /// Discrete surface energy [J], with the deferred flux of the last solution; renewed_: with that of d.
  double fracture_energy(const CellField<double>& d) const;
  double renewed_fracture_energy(const CellField<double>& d);
  /// The same per cell volume; half of a face's energy belongs to each of its cells [J/m^3].
  CellField<double> fracture_energy_density(const CellField<double>& d) const;
  /// Viscous resistance to changes of the damage from `from` [J/m^3], eta over the time step, from now on.
  void resist_change(double resistance, const CellField<double>& from);
  /// Energy that the resistance dissipates up to d [J]: int eta (d - d_n)^2/dt dV.
  double viscous_dissipation(const CellField<double>& d) const;
  bool is_damageable(Index cell) const { return damageable_[cell] != 0; }
  /// Residual of a cell per volume [J/m^3], with the deferred flux of the last solution.
  double imbalance(Index cell, const CellField<double>& d, double psi_plus) const {
    return residual(cell, d, psi_plus) / mesh_.cell_volume[cell];
  }

  /// Holds the damage of cells with a nonzero entry from now on; empty for none.
  void hold(CellField<char> held) { held_ = std::move(held); }
  const CellField<char>& held() const { return held_; }

  /// Additional source per volume [J/m^3], for manufactured solutions.
  void set_source(CellField<double> source) { source_ = std::move(source); }

 private:
  struct Link {
    Index face, P, N;
    double coefficient;  // A c [J]: of d_N - d_P
    bool corrected;      // not orthogonal, and both sides know their gradient
  };

  // -1 at the lower bound, 1 at the upper or held, 0 free.
  using ActiveSet = std::vector<signed char>;

  bool is_free(Index cell) const { return is_damageable(cell) && (held_.size() == 0 || held_[cell] == 0); }
  void build_links();
  void build_rows();
  Gradient build_gradient(const Vector& plane_normal);
  void renew_correction(const CellField<double>& d);
  double local_slope(Index cell, double d, double psi) const;            // of the local terms over the cell [J]
  double local_curvature(Index cell, double d, double psi) const;        // its derivative [J]
  double local_energy(Index cell, double d) const;                       // [J]
  double gradient_energy(Index link, const CellField<double>& d) const;  // of one face [J]
  double residual(Index cell, const CellField<double>& d, double psi) const;
  void choose_active(const CellField<double>& psi_plus, const CellField<double>& lower,
                     const std::vector<double>& diagonal, CellField<double>& d, ActiveSet& active) const;
  double times_off_diagonal(Index cell, const double* x) const;
  void solve_linear(const std::vector<double>& diagonal, const ActiveSet& active, std::vector<double>& residual,
                    std::vector<double>& x, DamageSolution& account);
  void factor(const std::vector<double>& diagonal, const ActiveSet& active);
  double precondition(const std::vector<double>& r, std::vector<double>& z) const;

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<char> damageable_;
  CellField<double> density_;      // Gc/(c0 ell) [J/m^3]
  CellField<double> conductance_;  // 2 Gc ell/c0 [J/m]
  CellField<double> pinned_;       // coefficient towards undamageable neighbours [J]
  std::vector<Link> links_;
  // Rows: the cells across each cell's links, in ascending order. Those that one incomplete factorisation couples are
  // [below, diagonal) before the cell and [diagonal, above) after it.
  struct Row {
    std::int32_t begin, below, diagonal, above, end;
  };
  std::vector<Row> rows_;
  std::vector<std::int32_t> columns_;
  std::vector<double> coefficients_;  // [J]
  std::vector<double> total_;         // of each row
  std::vector<double> deferred_;      // per cell: flux into it that is not two-point [J]
  std::vector<double> correction_;    // per link: flux towards P that is not two-point [J]
  Gradient gradient_;
  std::vector<Vector> gradients_;
  std::vector<double> range_;  // of damage over each cell and its neighbours
  CellField<double> source_;
  CellField<char> held_;
  double resistance_ = 0.0;     // [J/m^3]
  CellField<double> from_;      // empty without resistance
  std::vector<double> pivots_;  // of the incomplete factorisation, inverted; zero in active rows
};

}  // namespace pfdm
