#pragma once
// Memory of the gaps at the faces of cells that flow (plastic and endochronic ones). A gap is the difference of the
// strain there from that of the cell (CellMechanics::gaps), a small strain on top of it. A step of the law leaves the
// share theta of such a stress, as a radial return does of the stress itself (Material::left_by_flow):
//
//   r = theta (r_n + z - z_n),   traction mu scale(r),
//
// z being the gap and r its elastic part. Borne elastically for ever, gaps would carry loads beyond the limit load of a
// body that is perfectly plastic, and the more the farther it flows. Of hexahedra gaps keep the elastic Poisson's
// ratio, of other cells the bulk modulus bears them elastically. Cells with a pressure remember their volume changes
// likewise, by their gradient and by the flux through their faces, which the moderate bulk modulus bears.
//
// Half the work of traction and gap is part of a cell's energy. Energies here are per volume of the cell [J/m^3].

#include "mesh/mesh.h"
#include "physics/materials/material.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/body/cell_mechanics.h"
#include "solver/momentum/small_strain/history_stress.h"

#include <span>
#include <vector>

namespace pfdm {

class FlowingGaps {
 public:
  /// Whether gaps of such cells flow: not of polyhedra, whose rough modes grow otherwise, nor of pyramids.
  static bool can_flow(CellShape shape) { return shape != CellShape::polyhedron && shape != CellShape::pyramid; }

  /// Gaps of cells with these materials; null: elastic; empty: all elastic. So are those that cannot flow.
  FlowingGaps(const Mesh& mesh, const CellField<const Material*>& materials, const FractureModel& model);

  bool any() const { return any_; }
  bool has(Index cell) const { return any_ && material_[cell] != nullptr; }
  /// Count of the numbers that a cell remembers.
  std::size_t size(Index cell) const;
  /// Nothing flows until advance().
  void start_step();

  /// Moduli that a change of gaps meets in the step, undamaged.
  IsotropicElasticity elasticity(Index cell) const;
  /// Writes what a cell remembers into a history with room for all cells.
  void tell(Index cell, std::span<const double> numbers, HistoryStress& history) const;
  /// From the numbers at the start of the step to those at the gaps and volume changes of now; the flow of the step
  /// leaves the share `left` of their stress.
  void advance(Index cell, double left, const CellMechanics& now, std::span<const double> from, std::span<double> to);

  /// Heat of the gaps since the virgin state, and their stored energy less half of the work of their traction [J/m^3].
  static double dissipated(std::span<const double> numbers) { return numbers[0]; }
  static double locked(std::span<const double> numbers) { return numbers[1]; }

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
