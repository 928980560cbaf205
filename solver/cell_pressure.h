#pragma once
// Nearly incompressible cells carry a pressure: q, what tension adds to the stress beyond a moderate lambda_s, is an
// unknown of its own (a mixed form, as of Stokes' problem), for a reconstructed divergence times lambda locks, or
// oscillates, as nu -> 1/2.
//
//   sigma = lambda_s tr(G) I + 2 mu sym(G) + q I,  lambda_s = 2.5 mu of the undamaged material,
//   V q / (lambda - lambda_s) = sum over faces of u_f.S,
//
// with u_f the two-sided displacement of the face, at which the tractions of both its cells agree, q and all
// (momentum.h). What u_f owes to the difference of the two q keeps them from oscillating, as the pressure-weighted
// interpolation of Rhie and Chow (AIAA J. 21 (1983) 1525) does in collocated schemes for fluids: q is taken at the
// face, by its least-squares gradient, so that only what is rough in it is damped. Between cells of unlike damage q
// jumps by right: there its gradient counts less. Sums of u_f.S over neighbours cancel on their common face, which a
// warped face needs a term for: the flux of the gradient through its triangles.

#include "solver/gradient.h"
#include "solver/unknowns.h"

#include <vector>

namespace pfdm {

class CellPressure {
 public:
  CellPressure(const Mesh& mesh, const Unknowns& unknowns);

  bool any() const { return !unknowns_.pressure_cells.empty(); }
  /// Leaves lambda_s in the moduli of the cells with a pressure, which takes over the rest. In a damaged cell both are
  /// the same parts of lambda as in the undamaged one. g are the stiffness factors.
  void take_over(CellField<IsotropicElasticity>& moduli, const CellField<double>& g);
  /// The pressures among the unknowns, and their gradients.
  void read(const std::vector<Vector>& u);

  /// q [Pa], positive in tension, at the distance d from the cell's centre; zero in cells that have none.
  double at(Index cell, const Vector& d) const { return any() ? q_[cell] + slope_[cell].dot(d) : 0.0; }
  double mean(Index cell) const { return any() ? q_[cell] : 0.0; }
  /// lambda - lambda_s [Pa].
  double modulus(Index cell) const { return modulus_[cell]; }
  /// What a face's triangles let through beyond u_f.S at the displacement gradient G [m^3].
  double flux_of_warp(Index face, const Tensor& G) const {
    return warp_.size() > 0 ? G.cwiseProduct(warp_[face]).sum() : 0.0;
  }

 private:
  double likeness(Index cell, const CellField<double>& g) const;

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  Gradient gradient_;
  CellField<double> modulus_;  // [Pa]; empty, as all fields below, without pressures
  CellField<double> q_;        // [Pa]
  CellField<Vector> slope_;    // of q, as far as it counts [Pa/m]
  CellField<double> counts_;   // by how much it does: 1 among cells of equal damage, to 0
  FaceField<Tensor> warp_;     // sum over its triangles of S_t (x) (x_t - x_f) [m^3]; empty where all faces are plane
};

}  // namespace pfdm
