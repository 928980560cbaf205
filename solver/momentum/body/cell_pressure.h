#pragma once
// Nearly incompressible cells carry a pressure: the part q of the mean stress beyond that of a moderate lambda_s is an
// unknown of its own (a mixed form, as of Stokes' problem). The reason is that a reconstructed divergence times lambda
// locks or oscillates as nu -> 1/2.
//
//   sigma = lambda_s tr(G) I + 2 mu sym(G) + q I,  lambda_s = 2.5 mu of the undamaged material (or, if that is less,
//                                                   lambda - 0.2 K),
//   V q / (lambda - lambda_s) = sum over faces of u_f.S,
//
// with u_f the two-sided displacement of the face, at which the tractions of both its cells, q included, agree
// (isotropic_tractions.h). The dependence of u_f on the difference of the two q suppresses oscillations, as the
// pressure-weighted interpolation of Rhie and Chow (AIAA J. 21 (1983) 1525) does in collocated schemes for fluids. q is
// extrapolated to the face by its least-squares gradient, so that only rough pressures are damped. Between cells of
// different damage q may jump: there its gradient has a smaller weight. The fluxes u_f.S of two neighbours cancel on
// their common face; a warped face requires an additional term, the flux of the gradient through its triangles.

#include "solver/momentum/body/unknowns.h"
#include "solver/scalar/gradient.h"

#include <vector>

namespace pfdm {

/// The pressures of the cells for given unknowns, and their slopes.
struct PressureField {
  CellField<double> q;      ///< [Pa], positive in tension; zero in cells that have none; empty without any
  CellField<Vector> slope;  ///< of q, times its weight [Pa/m]; likewise

  /// q at the distance d from the cell's centre [Pa].
  double at(Index cell, const Vector& d) const { return q.size() > 0 ? q[cell] + slope[cell].dot(d) : 0.0; }
  double mean(Index cell) const { return q.size() > 0 ? q[cell] : 0.0; }
};

class CellPressure {
 public:
  /// lambda_s / mu. Measured on Goodier's sphere: 1.5 doubles the pole's error, 7 does so on polyhedra and takes up to
  /// twice the iterations.
  static constexpr double moderate_lambda = 2.5;
  /// The share of K that is left to the pressure at least, as of relaxing materials that are not nearly incompressible
  /// at all times.
  static constexpr double least_share = 0.2;

  CellPressure(const Mesh& mesh, const Unknowns& unknowns);

  bool any() const { return !unknowns_.pressure_cells.empty(); }
  /// Reduces lambda to lambda_s in the moduli of the cells with a pressure, which carries the rest. In a damaged cell
  /// both are the same fractions of lambda as in the undamaged one. g are the stiffness factors. `relaxes`: cells that
  /// relax, empty: none; `sound`: their undamaged moduli that a change of strain meets in the step [Pa]. Their K_s has
  /// its ratio to mu in the undamaged material and relaxes as mu does: g times that, or the share of K that a closed
  /// crack keeps.
  void take_over(CellField<IsotropicElasticity>& moduli, const CellField<double>& g,
                 const CellField<IsotropicElasticity>& sound, const CellField<char>& relaxes);
  /// Reduces lambda_s in the moduli of the cells' own stress where a crack is closed, to 2.5 of its shear modulus
  /// there, and leaves the rest to the pressure too: after take_over(). A closed crack has no shear stiffness that
  /// would make the cell's divergence agree with that of the fluxes.
  void bear_closed_cracks(CellField<IsotropicElasticity>& of_stress);
  /// The part of take_over() that does not concern the moduli: at finite strain, whose laws know their own.
  void weigh(const CellField<double>& g);
  /// Pressures that are zero, for read().
  PressureField field() const;
  /// Reads the pressures among the unknowns u, and finds their gradients.
  void read(const std::vector<Vector>& u, PressureField& pressures) const;

  /// lambda - lambda_s [Pa]; zero in cells that have none.
  double modulus(Index cell) const { return any() ? modulus_[cell] : 0.0; }
  /// lambda_s / mu of the undamaged material, in a cell that has a pressure.
  double moderate_ratio(Index cell) const { return ratio_[cell]; }
  /// Flux through a face's triangles beyond u_f.S at the displacement gradient G [m^3].
  double flux_of_warp(Index face, const Tensor& G) const {
    return warp_.size() > 0 ? G.cwiseProduct(warp_[face]).sum() : 0.0;
  }

 private:
  double likeness(Index cell, const CellField<double>& g) const;

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  Gradient gradient_;
  CellField<double> modulus_;  // [Pa]; empty, as all fields below, without pressures
  CellField<double> ratio_;    // lambda_s / mu
  CellField<double> counts_;   // weight of its gradient: 1 among cells of equal damage, to 0
  FaceField<Tensor> warp_;     // sum over its triangles of S_t (x) (x_t - x_f) [m^3]; empty where all faces are plane
};

}  // namespace pfdm
