#pragma once
// The stiffness c of the jump term on faces between polyhedra, which differs from that of the tractions, and between
// flat cells that bend.
//
// Polyhedra have about 14 faces against three unknowns: with a of the full lambda the jump terms lock as nu -> 0.5.
// Their c uses lambda_s = min(lambda, 1.5 mu) in the undamaged material, and the same fraction of lambda + 2 mu in a
// damaged one. It is blended back to the full one between cells of different damage: c = c(lambda_s) + theta (c(lambda)
// - c(lambda_s)), theta = 1 - min(mu_P, mu_N)/max(mu_P, mu_N). The weights of sigma_P and sigma_N keep the full lambda.
// On tetrahedra a smaller c would not converge. Polyhedra of general stiffness C keep the full a.
//
// Closed cracks in polyhedra: where the split keeps lambda, a broken cell has no shear stiffness (mu << lambda).
// Tangential displacements that alternate between such polyhedra have gradients without divergence, but cause forces on
// skew faces; without stabilisation they grow without bounds. Such cells therefore use the full c, and c_t + 0.05 c_n
// along the face between two of them in the jump term, which vanishes for a slip that is linear over the cells.
//
// Closed cracks in cells of any shape with a pressure have the same fault, and a pressure that varies along the crack
// meets no stiffness there. Between two of them it is c_t + 0.2 c_n, c_n being that of the moderate lambda_s. In
// relaxing cells it is the c_n of the relaxed material: a slip has no history.

#include "solver/momentum/faces/face_skeleton.h"

namespace pfdm {

/// lambda_s + 2 mu over lambda + 2 mu of the undamaged cells: 1 but in polyhedra without a pressure.
CellField<double> jump_shares(const Mesh& mesh, const Unknowns& unknowns);

class PolyhedralJump {
 public:
  /// `shares` as above. For use while both exist.
  PolyhedralJump(const FaceSkeleton& skeleton, const CellField<double>& shares);

  /// Takes the moduli of the cells, before plane stress or pressures change them; `sound`: undamaged ones, empty: those
  /// of the zones.
  void renew(const CellField<IsotropicElasticity>& moduli, const CellField<IsotropicElasticity>& sound);

  /// lambda_s + 2 mu of a cell with these moduli [Pa].
  double modulus(Index cell, const IsotropicElasticity& moduli) const {
    const double share = share_[cell] + liquidity_[cell] * (1.0 - share_[cell]);
    return share * moduli.constrained_modulus();
  }
  /// Along the normal of the face between P and N [Pa/m]; `full` is the value with the full lambda.
  double along_normal(Index P, Index N, const CellField<IsotropicElasticity>& moduli, double h_P, double h_N,
                      double full) const;
  /// Along the face [Pa/m].
  double along_face(Index P, Index N, double c_n, double c_t) const;
  /// Share of the tangential stiffness at a link between flat cells that bend.
  double bending_part(const momentum_faces::Link& link) const;

 private:
  const FaceSkeleton& skeleton_;
  const CellField<double>& share_;
  CellField<double> greatest_slip_;  // of a closed crack, over c along the normal; zero: in other cells
  CellField<double> liquidity_;      // 0 to 1: how closed (without shear stiffness) the crack of such a cell is
  CellField<double> slip_;           // at present, over c along the normal
};

}  // namespace pfdm
