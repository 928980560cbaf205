#pragma once
// Memory of the gaps at the faces of cells that flow (plastic and endochronic ones). A gap is a small strain on top of
// that of its cell (gap_memory.h). A step of the law leaves the share theta of such a stress, as a radial return does
// of the stress itself (Material::left_by_flow):
//
//   r = theta (r_n + z - z_n),   traction mu scale(r),
//
// z being the gap and r its elastic part. Borne elastically for ever, gaps would carry loads beyond the limit load of a
// body that is perfectly plastic, and the more the farther it flows. Of hexahedra gaps keep the elastic Poisson's
// ratio, of other cells the bulk modulus bears them elastically. Cells with a pressure remember their volume changes
// likewise, by their gradient and by the flux through their faces, which the moderate bulk modulus bears.

#include "solver/fracture/gaps/gap_memory.h"

#include <span>

namespace pfdm {

class FlowingGaps : public GapMemory {
 public:
  /// Whether gaps of such cells flow: not of polyhedra, whose rough modes grow otherwise, nor of pyramids.
  static bool can_flow(CellShape shape) { return shape != CellShape::polyhedron && shape != CellShape::pyramid; }

  /// Gaps of cells with these materials; null: elastic; empty: all elastic. So are those that cannot flow.
  FlowingGaps(const Mesh& mesh, const CellField<const Material*>& materials, const FractureModel& model);

  bool any() const override { return any_; }
  bool has(Index cell) const override { return any_ && material_[cell] != nullptr; }
  std::size_t size(Index cell) const override;
  /// Nothing flows until advance().
  void start_step(double duration, const CellField<double>& shift) override;
  IsotropicElasticity elasticity(Index cell) const override;
  void tell(Index cell, std::span<const double> numbers, HistoryStress& history) const override;
  void hold(Index, std::span<double>) const override {}
  void advance(Index cell, double left, const CellMechanics& now, std::span<const double> from,
               std::span<double> to) override;

 private:
  // Whether bulk moduli bear gaps as shear moduli do: of hexahedra, on which the bulk modulus alone locks. Others have
  // rough modes without it.
  bool keeps_ratio(Index cell) const;
  // Bulk modulus that gaps along the normals of faces meet where they keep the ratio; else 0 [Pa].
  double bulk_modulus(Index cell) const {
    return keeps_ratio(cell) ? material_[cell]->elasticity().bulk_modulus() : 0.0;
  }

  const Mesh& mesh_;
  const FractureModel& model_;
  bool any_ = false;
  CellField<const Material*> material_;  // of cells that flow, else null
  CellField<double> left_;               // theta of the step
};

}  // namespace pfdm
