#pragma once
// The damage equation at fixed displacement, from the surface energy (Gc/c0) (alpha(d)/ell + ell |grad d|^2):
//
//   (Gc/(c0 ell)) alpha'(d) + (1 - k) g'(d) psi_plus - div((2 Gc ell/c0) grad d) = 0,  lower <= d <= 1,
//
// no flux through the boundary, d = 0 in regions that cannot be damaged. Two-point fluxes, in series where Gc or ell
// jumps, with a deferred correction by two-ring gradients for faces that are not orthogonal to their centre line. The
// correction is not limited: a limiter at half of the two-point flux takes the order on tetrahedra from 2 to 0.8, and
// the bounds hold all the same, by a primal-dual active set
// (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13 (2002) 865), linear systems by conjugate gradients.

#include "solver/fracture_model.h"
#include "solver/gradient.h"

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

  /// Solves for d [-] from its present value, given psi_plus [J/m^3] and the lower bound. `corrections` times the
  /// deferred flux is renewed; 1 suits a staggered loop, which renews it at each of its own iterations.
  DamageSolution solve(const CellField<double>& psi_plus, const CellField<double>& lower, Index corrections,
                       CellField<double>& d);

  /// Discrete surface energy [J].
  double fracture_energy(const CellField<double>& d) const;
  bool is_damageable(Index cell) const { return damageable_[cell] != 0; }

  /// Additional source per volume [J/m^3], for manufactured solutions.
  void set_source(CellField<double> source) { source_ = std::move(source); }

 private:
  struct Link {
    Index face, P, N;
    double coefficient;  // A c [J]: of d_N - d_P
    bool corrected;      // not orthogonal, and both sides know their gradient
  };

  // Active rows keep their value.
  using ActiveSet = std::vector<char>;

  void build_links();
  void build_rows();
  Gradient build_gradient(const Vector& plane_normal);
  void renew_correction(const CellField<double>& d);
  double local_slope(Index cell, double d, double psi) const;      // of the local terms over the cell [J]
  double local_curvature(Index cell, double d, double psi) const;  // its derivative [J]
  double residual(Index cell, const CellField<double>& d, double psi) const;
  void choose_active(const CellField<double>& psi_plus, const CellField<double>& lower, bool first,
                     CellField<double>& d, ActiveSet& active) const;
  void solve_linear(const std::vector<double>& diagonal, const ActiveSet& active, std::vector<double>& residual,
                    std::vector<double>& x, DamageSolution& account);
  void factor(const std::vector<double>& diagonal, const ActiveSet& active);
  void precondition(const ActiveSet& active, const std::vector<double>& r, std::vector<double>& z) const;

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<char> damageable_;
  CellField<double> density_;      // Gc/(c0 ell) [J/m^3]
  CellField<double> conductance_;  // 2 Gc ell/c0 [J/m]
  CellField<double> pinned_;       // coefficient towards undamageable neighbours [J]
  std::vector<Link> links_;
  // Rows: the links of each cell with the cell across.
  struct Entry {
    Index column, link;
    double coefficient;
  };
  std::vector<std::size_t> offsets_;
  std::vector<Entry> entries_;
  std::vector<double> correction_;  // per link: flux towards P that is not two-point [J]
  Gradient gradient_;
  std::vector<Vector> gradients_;
  CellField<double> source_;
  std::vector<double> pivots_;  // of the incomplete factorisation
};

}  // namespace pfdm
