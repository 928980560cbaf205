#pragma once
// The damage equation at fixed displacement, from the surface energy (Gc/c0) (alpha(d)/ell + ell |grad d|^2):
//
//   (Gc/(c0 ell)) alpha'(d) + (1 - k) g'(d) psi_plus - div((2 Gc ell/c0) grad d) = 0,  lower <= d <= 1,
//
// no flux through the boundary, d = 0 in undamageable regions. Where the stiffness has a damage of its own
// (stiffness_damage.h), the term in psi_plus is A^T (g'(D) phi' psi_plus). It is linearised about the d that a solution
// begins with, with a diagonal that bounds its derivative from above, so that each solution descends. With a strength
// model Gc is delta Gc, and an external driving force c adds -g(d) c (physics/materials/strength_model.h). With fatigue
// it is f Gc (physics/damage/fatigue.h). With a viscosity eta (Ginzburg-Landau; Miehe, Welschinger, Hofacker,
// Int. J. Numer. Meth. Engng 83 (2010) 1273) the left side has eta (d - d_n)/dt as well. Two-point fluxes, bounds by
// active set: two_point_flux.h, bounded_newton.h.

#include "solver/fracture/damage/stiffness_damage.h"
#include "solver/fracture/model/driving_law.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/scalar/bounded_newton.h"
#include "solver/scalar/two_point_flux.h"

namespace pfdm {

class DamageEquation {
 public:
  /// plane_normal: of one-cell-thick meshes, else zero.
  DamageEquation(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

  /// Solves for d [-] from its present value, given psi_plus [J/m^3] and the lower bound.
  ScalarSolution solve(const CellField<double>& psi_plus, const CellField<double>& lower,
                       const ScalarTolerance& tolerance, CellField<double>& d);
  /// Solves for d where psi_plus depends on d.
  ScalarSolution solve(const DrivingLaw& psi_plus, const CellField<double>& lower, const ScalarTolerance& tolerance,
                       CellField<double>& d);

  /// The damage of least surface energy that is nowhere below `given`: the optimal profile about cracks whose cells are
  /// given as broken. Their surface energy is then about Gc times their area, whatever was given beside them.
  CellField<double> relaxed(const CellField<double>& given);

  /// Discrete surface energy [J], with the deferred flux of the last solution; renewed_: with that of d.
  double fracture_energy(const CellField<double>& d) const;
  double renewed_fracture_energy(const CellField<double>& d);
  /// Discrete surface energy per cell volume; half of a face's energy belongs to each of its cells [J/m^3].
  CellField<double> fracture_energy_density(const CellField<double>& d) const;
  /// int ell^2 |grad d|^2 over int d^2, weighted by Gc/(c0 ell): 1 about a crack of AT2, 0 where d is uniform.
  double unevenness(const CellField<double>& d) const;
  /// Whether the stress of a uniform body of this cell's material falls while its strain and damage grow, at psi_plus.
  bool softens(Index cell, double d, double psi_plus) const;
  /// Viscous resistance to changes of the damage from `from` [J/m^3], eta over the time step, from now on.
  void resist_change(double resistance, const CellField<double>& from);
  /// Factor f of the toughness of each cell [-] (physics/damage/fatigue.h), from now on; 1 before. If it is another
  /// than the present one the deferred flux becomes that of d.
  void set_toughness_factor(CellField<double> factor, const CellField<double>& d);
  const CellField<double>& toughness_factor() const { return toughness_factor_; }
  /// External driving force c [J/m^3], from now on; empty: none.
  void set_driving_force(CellField<double> force) { force_ = std::move(force); }
  /// Energy that the resistance dissipates up to d [J]: int eta (d - d_n)^2/dt dV.
  double viscous_dissipation(const CellField<double>& d) const;
  /// The part of it in a cell [J].
  double viscous_dissipation(Index cell, double d) const;
  /// The left side of a cell's equation, over the cell [J], with the deferred flux of the last solution; its derivative
  /// by d is `diagonal`, those by the other cells' are minus the coefficients of `coupling`.
  double imbalance(Index cell, const CellField<double>& d, double psi_plus) const;
  double diagonal(Index cell, double d, double psi_plus) const;
  const SymmetricCoupling& coupling() const { return flux_.coupling(); }
  /// Damage by which the stiffness is degraded.
  const StiffnessDamage& stiffness_damage() const { return stiffness_damage_; }
  /// Derivatives of the stiffness factors by the means of d, at d [-].
  CellField<double> stiffness_slopes(const CellField<double>& d) const;
  /// Second derivative of the energy of degraded stiffness by the means of d, at the d with which the last solution
  /// began, and the diagonal that stood for it [J]; zero where each cell's own d degrades it.
  double mean_curvature(Index cell) const { return drive_.curvature.size() > 0 ? drive_.curvature[cell] : 0.0; }
  double mean_diagonal(Index cell) const { return drive_.diagonal.size() > 0 ? drive_.diagonal[cell] : 0.0; }
  bool is_damageable(Index cell) const { return damageable_[cell] != 0; }
  /// Additional source per volume [J/m^3], for manufactured solutions.
  void set_source(CellField<double> source) { source_ = std::move(source); }

 private:
  template <class Driving>
  struct Term;
  double local_slope(Index cell, double d, double psi) const;              // of the local terms over the cell [J]
  double local_curvature(Index cell, double d, double psi) const;          // its derivative [J]
  double driving_curvature(Index cell, double d, double psi_slope) const;  // the part of it that psi's slope adds [J]
  double local_energy(Index cell, double d) const;                         // [J]
  void linearise_drive(const CellField<double>& psi_plus, const CellField<double>& d);

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<char> damageable_;
  CellField<double> sound_density_;     // Gc/(c0 ell) [J/m^3]
  CellField<double> toughness_factor_;  // f [-]
  CellField<double> density_;           // f Gc/(c0 ell) [J/m^3]
  TwoPointFlux flux_;                   // of the conductance 2 Gc ell/c0 [J/m]
  StiffnessDamage stiffness_damage_;
  // The term in psi_plus, linearised about `from`: its slope there, diagonal for its derivative, and derivative by the
  // means of d [J]; empty where it is each cell's own.
  struct Drive {
    CellField<double> from, slope, diagonal, curvature;
  };
  Drive drive_;
  CellField<double> source_;
  CellField<double> force_;  // empty without
  double resistance_ = 0.0;  // [J/m^3]
  CellField<double> from_;   // empty without resistance
};

}  // namespace pfdm
