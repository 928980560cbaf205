#pragma once
// The stiffness of damaged cells at small strain. Where the energy split keeps compression it depends on the strain. It
// is taken at the last one: secant moduli where the split has isotropic ones, else its tangent. The tangent is the
// secant as well (energies of second degree), so the solves are Newton's steps. Cells with a history are linearised
// about it, with a stress of their own.

#include "solver/fracture/cells/cell_law.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/material_cells.h"

#include <vector>

namespace pfdm {

class SmallStiffness final : public CellStiffness {
 public:
  SmallStiffness(const Mesh& mesh, const FractureModel& model);

  void start_step(double duration, const CellField<double>& shift = {}) override;
  CellHistories virgin_histories() const override { return materials_.virgin_histories(); }
  std::vector<OutputHistory> output(const CellHistories& histories) const override {
    return materials_.output(histories);
  }
  void hold(FractureState& state) override { materials_.hold(state.histories); }

  BalanceIs balance_is() const override { return is_isotropic_ ? BalanceIs::linear : BalanceIs::convex; }
  bool has_histories() const override { return materials_.any(); }
  CellField<IsotropicElasticity> degradable_part(const FractureState& state) const override;
  double follow(const CellMechanics& mechanics, FractureState& state) override;
  double integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state) override;

  CellEnergies energies(const CellMechanics& mechanics, const FractureState& state) const override;
  double driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const override;
  double stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const override;
  bool depends_on_strain() const override;
  CellField<Mandel> eigenstrain_moments(const CellMechanics& mechanics, const FractureState&,
                                        const Vector&) const override {
    return mechanics.traction_moment;
  }
  using CellStiffness::plastic_dissipation;
  double plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const override;
  Tensor undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState& state) const override;

 private:
  void give(const FractureState& state, const CellField<double>& g, MomentumSolver& momentum) const override;
  const IsotropicElasticity& elasticity(Index cell) const { return model_.in_cell(mesh_, cell).elasticity; }
  const CellLaw& law(Index cell) const { return *laws_[model_.cells.size() > 0 ? cell : mesh_.region[cell]]; }
  // The law of every cell, with its g and closure.
  StrainLaw strain_law(const CellField<double>& g, const CellField<double>& closure) const;
  // Cells with a history at the state; their moduli become those that gaps meet.
  HistoryStress with_histories(const FractureState& state, const CellField<double>& g,
                               CellField<IsotropicElasticity>& moduli) const;
  double driving_energy(Index cell, const CellMechanics& mechanics) const;  // without a history
  double driving_energy(Index cell, const CellMechanics& mechanics, const MaterialEnergy& material,
                        const FractureState& state) const;
  double stored_energy(Index cell, const CellMechanics& mechanics, const MaterialEnergy& material, double g) const;
  // Whether the driving energy is that of a part of the stiffness (CellMechanics::part_energy).
  bool has_degradable_part(Index cell) const;
  // Whether the driving energy of a cell with a history is, too, or is all that it stores.
  bool drives_by_faces(Index cell) const;
  bool is_variational(Index cell) const { return model_.split_of(model_.in_cell(mesh_, cell)).is_variational(); }
  bool descends(Index cell) const override { return has_degradable_part(cell); }
  Tensor closing_strain(Index cell, const CellMechanics& mechanics, double g, double closure) const;
  double follow_with_closure(Index cell, const CellMechanics& mechanics, FractureState& state);

  MaterialCells materials_;
  std::vector<std::shared_ptr<const CellLaw>> laws_;  // by region, or by cell where regions vary
  bool is_isotropic_;                                 // every cell has isotropic secant moduli
};

}  // namespace pfdm
