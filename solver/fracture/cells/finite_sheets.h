#pragma once
// The cells of a plate in plane stress at finite strain.
//
// Plane stress: F has the stretch across the plate at which the damaged cell has no stress across it, and the tangent
// is condensed accordingly. No pressure is needed.

#include "solver/fracture/cells/finite_cells.h"

namespace pfdm {

class FiniteSheets final : public FiniteCells {
 public:
  /// Of a model of finite strain in plane stress.
  FiniteSheets(const Mesh& mesh, const FractureModel& model);

  Tensor thinned(Index cell, const CellMechanics& mechanics, const Degraded& left) const override;

 private:
  Tensor elastic(const Tensor& H, const FreeDeformation& free) const override;
  FiniteLaw elastic_law(FinitePlace at, const Tensor& H, const Degraded& left) const override;
  Tensor thinned(FinitePlace at, const Tensor& H, const Degraded& left) const override;
  Tensor true_deformation(Index cell, const Tensor& H, const Degraded& left) const override;

  Vector across_ = Vector::Zero();  // the plate's normal
};

}  // namespace pfdm
