#pragma once
// The cells of a body at finite strain: hyperelastic laws (physics/materials/hyperelastic.h). Damage degrades the part
// of the energy W that the split does not keep:
//
//   none                   W = g W(F)
//   volumetric_deviatoric  W = g (W(F) - W_c) + W_c,  W_c = W(J^(1/3) 1) where J < 1, else 0
//
// Broken cells may stretch without end or turn inside out: W and its stress are finite for any F (the functions of J go
// on as parabolas below J = 0.1), their tangent is that of the true stress, and no step is refused for the sake of a
// cell's orientation.

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
  /// At the displacement gradient H and the stiffness factor g. The faces are as stiff as `closure` says: 1 where J < 1
  /// and the split keeps the bulk modulus, 0 where J > 1.
  FiniteLaw law(Index cell, const Tensor& H, double g, double closure) const;
  /// The closure at the volume J, which changes over a range of J: the stiffness of the faces may not jump.
  double closure(Index cell, const Tensor& H) const;

  /// The energy that a cell stores [J], by its mean gradient and what the tractions of its faces add (momentum.h).
  double stored_energy(Index cell, const CellMechanics& mechanics, double g) const;
  /// Its derivative by g, per volume [J/m^3].
  double driving_energy(Index cell, const CellMechanics& mechanics, double g) const;

  /// Cauchy stress [Pa] from the first Piola-Kirchhoff stress of the tractions, with that across a plane mesh.
  Tensor cauchy_stress(Index cell, const CellMechanics& mechanics, double g, const Vector& plane_normal) const;

 private:
  // Of the part that damage degrades and of that which it does not.
  struct Parts {
    PotentialAt degraded, kept;
  };
  Parts parts(Index cell, const Tensor& H) const;

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<const HyperelasticMaterial*> material_;  // empty at small strain
  CellField<char> keeps_compression_;
};

}  // namespace pfdm
