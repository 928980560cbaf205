#pragma once
// Common part of the tractions at small strain: eigenstrains, and the strains, stresses and energies of the cells.
//
// Eigenstrains eps*: each side of a face has the initial traction -n.C eps*, so that tractions agree across a face also
// where eps* jumps. Axisymmetric meshes (a sector one cell wide): the gradient also has the hoop strain u_r / r. The
// two faces of the sector act on the cell with the hoop stress sigma_phi: -2 sin(half the angle) A sigma_phi along r.
// Plane stress: the stiffness is condensed to zero stress across the plate (physics/elasticity/plane_stress.h); the
// strain across it is added to that of the displacements.

#include "solver/momentum/body/cell_eigenstrain.h"
#include "solver/momentum/faces/cell_reconstruction.h"
#include "solver/momentum/faces/cell_sums.h"
#include "solver/momentum/faces/face_tractions.h"

#include <algorithm>

namespace pfdm {

/// An isotropic part of the stiffness, in the cell and on its faces.
struct IsotropicPart {
  IsotropicElasticity moduli, jump;
  Tensor of_cell(const Tensor& strain) const { return stress(moduli, strain); }  ///< [Pa]
  Tensor at_face(const Tensor& strain) const { return stress(jump, strain); }    ///< [Pa]
  /// Least energy [J/m^3] of a cell, given that of its mean strain.
  double least(double mean) const { return std::min(mean, 0.0); }
};

class SmallTractions : public FaceTractions {
 public:
  /// For use while all of these exist.
  SmallTractions(const FaceSkeleton& skeleton, CellReconstruction& cells, const CellEigenstrain& eigenstrain);

  bool has_third_order() const override { return cells_.cubic().any() || cells_.layers().any(); }
  CellMechanics mechanics(const std::vector<Vector>& u, bool with_gradient,
                          const CellField<IsotropicElasticity>& part) const override;

 protected:
  /// Adds the strain across the plate in plane stress; else the gradient as it is.
  virtual Tensor with_strain_across(Index cell, const Tensor& gradient) const = 0;
  /// Stress [Pa] across the plane of a plane mesh, none in plane stress.
  virtual double stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const = 0;
  /// Energy per volume [J/m^3] of a part of the cell's stiffness (CellMechanics::part_energy).
  virtual double energy_of_part(Index cell, const IsotropicElasticity& part, const Tensor& strain,
                                const FaceMoves& moves) const = 0;
  /// Finds the eigenstrains on sides with gradients of their own.
  void extrapolate_eigenstrains();
  bool varies_eigenstrain() const { return !eigenstrain_changes_.empty(); }
  /// Difference of the eigenstrain on side number `turn` from that of its cell [-].
  Tensor eigenstrain_change(std::size_t turn) const {
    return varies_eigenstrain() ? eigenstrain_changes_[turn] : Tensor::Zero();
  }
  /// Adds the results that materials with a history need.
  virtual void add_histories(const FaceMoves&, CellMechanics&) const {}

  /// The energy of the mean strain and of the differences of the faces' strains from it; without eigenstrains, of which
  /// the cell has one. strain_at(turn, d, n, move) is the gradient at a face that moves by `move`.
  template <class Part, class StrainAt>
  double energy_over_faces(Index cell, const Part& part, const Tensor& strain, const FaceMoves& moves,
                           const StrainAt& gradient_at) const;
  /// A part of the stiffness with the same share of lambda + 2 mu as the jump has of the whole.
  IsotropicPart with_jump_modulus(Index cell, const IsotropicElasticity& part) const;
  bool is_plane_stress() const { return skeleton_.unknowns.plane_stress; }
  const Vector& plane_normal() const { return skeleton_.unknowns.plane_normal; }

  CellReconstruction& cells_;
  const CellEigenstrain& eigenstrain_;
  CellField<double> jump_share_;  // lambda_s + 2 mu over lambda + 2 mu, undamaged; 1 except in polyhedra

 private:
  std::vector<Tensor> eigenstrain_changes_;  // by turn; empty without eigenstrains or lines

  void finish_stress(Index cell, const CellSums& sums, const Sweep& sweep, CellMechanics& result) const;
};

template <class Part, class StrainAt>
double SmallTractions::energy_over_faces(Index cell, const Part& part, const Tensor& strain, const FaceMoves& moves,
                                         const StrainAt& gradient_at) const {
  const Mesh& mesh = skeleton_.mesh;
  const Tensor elastic = eigenstrain_.elastic_part(cell, strain), mean_stress = part.at_face(elastic);
  double varying = 0.0;
  const FaceSkeleton::SignedForce* next = skeleton_.forces_of(cell).data();
  for (const Index f : mesh.faces_of_cell(cell)) {
    if (skeleton_.force_of_face[f] < 0) continue;
    const std::size_t turn = skeleton_.turn_at(*next++);
    const Vector area = mesh.outward_area(f, cell);
    const Vector n = area.normalized(), d = mesh.face_centre[f] - mesh.cell_centre[cell];
    const Vector move = moves.seen_from(cell, f) - moves.u[cell];
    const Tensor at_face = with_strain_across(cell, gradient_at(turn, d, n, move) - eigenstrain_change(turn));
    const Tensor change = part.at_face(eigenstrain_.elastic_part(cell, symmetric_part(at_face))) - mean_stress;
    const Vector elastic_move = eigenstrain_.any() ? (move - to_tensor(eigenstrain_[cell]) * d).eval() : move;
    varying += 0.5 * elastic_move.dot(change * area);
  }
  double mean = 0.5 * contract(part.of_cell(elastic), elastic);
  // Strain along lines of cells, which is the cell's, acts across the plane; within it the faces do all.
  if (const double counts = cells_.layers().counts(cell); counts > 0.0 && !is_plane_stress()) {
    const Tensor beyond = counts * (symmetric_part(moves.sweep.gradients[cell]) - strain);
    mean +=
        0.5 * plane_normal().dot(part.of_cell(beyond) * plane_normal()) * plane_normal().dot(elastic * plane_normal());
  }
  return std::max(mean + varying / mesh.cell_volume[cell], part.least(mean));
}

}  // namespace pfdm
