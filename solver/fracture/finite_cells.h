#pragma once
// The cells of a body at finite strain: hyperelastic laws (physics/materials/hyperelastic.h), linearised about the
// displacement gradient H that the state's histories hold for every cell. Damage degrades the part of the energy W that
// the split does not keep:
//
//   none                   W = g W(F)
//   volumetric_deviatoric  W = g (W(F) - W_c) + W_c,  W_c = W(J^(1/3) 1) where J < 1, else 0
//
// Broken cells (g < 1e-3) may stretch without end or turn inside out: they go on with the law linearised where they
// were at the beginning of the step, before which they carried load, and lose what depends on their own deformation.

#include "mesh/mesh.h"
#include "physics/materials/hyperelastic.h"
#include "solver/fracture/fracture_model.h"
#include "solver/fracture/state.h"
#include "solver/momentum/momentum_solver.h"

namespace pfdm {

class FiniteCells {
 public:
  FiniteCells(const Mesh& mesh, const FractureModel& model);

  bool any() const { return material_.size() > 0; }
  /// H = 0 in every cell.
  CellHistories virgin_histories() const;
  /// About the histories' H, with the stiffness factors g.
  CellField<GradientStress> linearised(const CellField<double>& g, const CellHistories& histories) const;
  /// The linearisation follows to these gradients, in broken cells back to where it was at the `start` of the step.
  /// Returns false, and the histories as they were, if the volume of some sound cell would shrink below a tenth of what
  /// it was.
  bool follow(const CellField<Tensor>& gradients, const CellField<double>& g, const CellHistories& start,
              CellHistories& histories) const;

  /// The energy that a cell stores [J], by its mean gradient and what the tractions of its faces add (momentum.h).
  double stored_energy(Index cell, const CellMechanics& mechanics, double g, const CellHistories& histories) const;
  /// Its derivative by g, per volume [J/m^3].
  double driving_energy(Index cell, const CellMechanics& mechanics, double g, const CellHistories& histories) const;

  /// Cauchy stress [Pa] from the first Piola-Kirchhoff stress of the tractions, with that across a plane mesh.
  Tensor cauchy_stress(Index cell, const CellMechanics& mechanics, double g, const CellHistories& histories,
                       const Vector& plane_normal) const;

 private:
  // Of the part that damage degrades and of that which it does not.
  struct Parts {
    PotentialAt degraded, kept;
  };
  Parts parts(Index cell, const Tensor& H) const;
  Parts extended(Index cell, const Tensor& H, double g, const CellHistories& histories) const;

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<const HyperelasticMaterial*> material_;  // empty at small strain
  CellField<char> keeps_compression_;
};

}  // namespace pfdm
