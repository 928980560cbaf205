#pragma once
// The cells whose material is a law with a history (physics/materials/material.h). Damage degrades their effective
// stress sigma_0(eps, history), which does not depend on damage: sigma = g sigma_0, plus the elastic stress that the
// energy split keeps in compression. The law says which part of the stored energy drives damage (MaterialEnergy); the
// rest, `idle`, becomes heat where damage frees it. So work = stored energy + surface energy + g times the dissipation
// of the effective material + heat of what was idle. Strains are those less the eigenstrain.
//
// Within a load step each equilibrium is linear, with the stress linearised at the last strain eps_k by the consistent
// tangent T: sigma_0 = sigma_0(eps_k) + T (eps - eps_k). The first of a step is elastic, as the load may reverse; that
// of laws that are linear is the one of the step, about what their cells come to if held. The strain is the
// least-squares one, which also enters the tractions of the faces. With any other, the converged solution would depend
// on T, which changes with the direction of the increment, and the iteration would not converge.

#include "mesh/mesh.h"
#include "physics/elasticity/linear_stress.h"
#include "solver/fracture/gaps/gap_memory.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include <memory>
#include <vector>

namespace pfdm {

class MaterialCells {
 public:
  MaterialCells(const Mesh& mesh, const FractureModel& model);

  bool any() const { return any_; }
  bool has(Index cell) const { return any_ && material_[cell] != nullptr; }

  /// Begins a load step, which takes `duration` [s]. `shift`: a_T of every cell (temperature_shift.h); empty: 1.
  void start_step(double duration, const CellField<double>& shift = {});
  /// Takes cells of laws that are linear from the start of the step to its end at held strains: their stress is then
  /// that of the step at any strain.
  void hold(CellHistories& histories);
  /// Takes a cell from its history at the start of the step to its strain of now. Returns the error [J/m^3] of its
  /// energy density with the previous linearised stress; NaN if the material's step cannot be solved.
  double advance(Index cell, const CellMechanics& mechanics, const CellHistories& from, CellHistories& to);
  /// The undamaged stress about the cell's state.
  LinearStress linearised(Index cell, const CellHistories& histories) const;
  /// Moduli that the gaps of a cell meet in the step, less those of its elasticity, undamaged [Pa].
  IsotropicElasticity beyond_elasticity(Index cell) const;
  /// Memory of the cells of relaxing materials, with room for the stress of every cell.
  HistoryStress history_stress(const CellHistories& histories) const;
  /// Energies of the undamaged material, with those of the gaps at its faces. The driving one is of the mean strain
  /// alone: SmallStiffness has it from what the faces store (CellMechanics::part_energy).
  MaterialEnergy energy(Index cell, const CellHistories& histories) const;
  /// Elasticity once all has relaxed in time; of other materials that which they have.
  IsotropicElasticity relaxed_elasticity(Index cell) const { return material_[cell]->relaxed_elasticity(); }
  /// Whether all that a cell stores drives its damage, but for what its energy split keeps; else what relaxed moduli
  /// store (PronyDrive).
  bool all_drives(Index cell) const;
  CellHistories virgin_histories() const;
  std::vector<OutputHistory> output(const CellHistories& histories) const;

 private:
  double duration(Index cell) const { return shift_.size() > 0 ? duration_ / shift_[cell] : duration_; }
  // Numbers of the law alone, without those of the gaps.
  std::span<const double> law_numbers(Index cell, const CellHistories& histories) const {
    return histories.of(cell).first(material_[cell]->history_size());
  }
  std::span<const double> gap_numbers(Index cell, const CellHistories& histories) const {
    return histories.of(cell).subspan(material_[cell]->history_size());
  }

  const Mesh& mesh_;
  const FractureModel& model_;
  bool any_ = false;
  double duration_ = 0.0;                // of the step [s]
  CellField<double> shift_;              // a_T in it; empty: 1
  CellField<const Material*> material_;  // null: elastic
  std::vector<std::unique_ptr<GapMemory>> memories_;
  CellField<GapMemory*> memory_;     // of the gaps of each cell; null: elastic
  CellField<MandelMatrix> tangent_;  // [Pa]; empty without such cells
};

}  // namespace pfdm
