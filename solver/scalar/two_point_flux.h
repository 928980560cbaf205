#pragma once
// -div(k grad u) of a scalar field with one value per cell: two-point fluxes, in series where k jumps, with a deferred
// correction by two-ring gradients for faces that are not orthogonal to their centre line. It is exact for linear
// fields. For fields with fronts it can be limited to the range of u around the face; a limiter at half of the
// two-point flux takes the order on tetrahedra from 2 to 0.8.

#include "mesh/mesh.h"
#include "solver/linear/conjugate_gradients.h"
#include "solver/scalar/gradient.h"

#include <vector>

namespace pfdm {

/// Flux out of a cell through one of its faces, per area: coefficient (u_face - value), to surroundings beyond a
/// boundary layer (Robin) or, with an infinite coefficient, to a face where u is `value`.
struct Exchange {
  Index face = 0, cell = 0;
  double coefficient = 0.0;  ///< [flux per area and unit of u]
  double value = 0.0;        ///< of u
  bool corrected = true;     ///< where the face is not orthogonal to the line from the cell's centre
};

class TwoPointFlux {
 public:
  struct Medium {
    CellField<double> conductance;  ///< k; zero: no flux through the cell's faces
    std::vector<Exchange> exchanges{};
    Vector plane_normal = Vector::Zero();  ///< of one-cell-thick meshes
    FaceField<char> cut{};                 ///< nonzero where there is no flux; or empty
    /// Across each interior face: jump of u over the flux per area, at infinity no flux; u has a kink or a jump where
    /// it is not zero. Or empty.
    FaceField<double> resistance{};
    CellField<Vector> shift{};  ///< of the point of a cell's value from the cell's centre [m]; or empty
    bool limited = false;       ///< the deferred correction, to the range of u around a face
  };
  TwoPointFlux(const Mesh& mesh, Medium medium);

  /// Multiplies the conductances of the medium by a positive factor for each cell, from now on. Gradients are those of
  /// the medium: where factors vary u has no kink. The deferred correction has to be renewed.
  void scale(CellField<double> factor);

  /// Renews the deferred correction with the gradients of u.
  void renew_correction(const CellField<double>& u);

  /// Flux out of a cell plus `local`, with the deferred correction of the last u.
  double balance(Index cell, const CellField<double>& u, double local) const {
    return local + diagonal(cell) * u[cell] - coupling_.times(cell, u.data()) - deferred_[cell];
  }
  double diagonal(Index cell) const { return exchanged_[cell] + coupling_.total(cell); }  ///< d balance/d u_cell
  double exchanged(Index cell) const { return exchanged_[cell]; }                         ///< part of it by exchanges
  const SymmetricCoupling& coupling() const { return coupling_; }

  /// A face through which there is a flux between two cells.
  struct Link {
    Index face, P, N;
    double coefficient;  // of u_P - u_N in the flux from P to N
    bool corrected;      // not orthogonal, and both sides know their gradient
  };
  const std::vector<Link>& links() const { return links_; }
  /// Energy 1/2 k |grad u|^2 of a link, the deferred correction included.
  double energy(Index link, const CellField<double>& u) const;
  const std::vector<Exchange>& exchanges() const { return medium_.exchanges; }
  /// Flux through exchange number k of the medium, out of its cell.
  double exchange_flux(std::size_t k, const CellField<double>& u) const;

 private:
  void build_links();
  void build_exchanges();
  double conductance(Index cell) const {
    return factor_.size() > 0 ? factor_[cell] * medium_.conductance[cell] : medium_.conductance[cell];
  }
  double link_coefficient(Index face) const;
  bool is_oblique(const Exchange& exchange) const;
  double resistance_of(Index face) const { return medium_.resistance.size() > 0 ? medium_.resistance[face] : 0.0; }
  bool is_cut(Index face) const;
  FaceField<char> kinks() const;
  Vector point_of(Index cell) const;                                       // that its value stands for [m]
  Vector within_face(Index face, Index cell, const Vector& normal) const;  // of the way from there to the face [m]
  Gradient build_gradient() const;

  const Mesh& mesh_;
  Medium medium_;
  CellField<double> factor_;  // of the conductances; empty: 1
  std::vector<Link> links_;
  std::vector<double> exchange_coefficient_;  // of each exchange: of u_cell - value, times the area
  CellField<double> exchanged_;
  SymmetricCoupling coupling_;
  Gradient gradient_;
  std::vector<Vector> gradients_;
  std::vector<double> range_;                // of u over each cell and its neighbours, or no limit
  std::vector<double> correction_;           // per link: flux towards P that is not two-point
  std::vector<double> exchange_correction_;  // per exchange: flux into the cell that is not two-point
  std::vector<double> deferred_;             // per cell: flux into it that is not two-point, or from outside
};

}  // namespace pfdm
