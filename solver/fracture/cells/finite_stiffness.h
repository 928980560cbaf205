#pragma once
// The stiffness of damaged cells at finite strain (finite_cells.h).

#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/finite_cells.h"

namespace pfdm {

class FiniteStiffness final : public CellStiffness {
 public:
  FiniteStiffness(const Mesh& mesh, const FractureModel& model)
      : CellStiffness(mesh, model), cells_(make_finite_cells(mesh, model)) {}

  void prepare(MomentumSolver& momentum) override { cells_->set_own_sides(momentum.own_sides_at_finite_strain()); }
  CellHistories virgin_histories() const override { return cells_->histories().virgin_histories(); }
  void start_step(double duration, const CellField<double>& shift = {}) override {
    cells_->shift_times(shift);
    CellStiffness::start_step(duration, shift);
  }
  void start_from(const FractureState& start, double duration) override {
    cells_->start_from(start.histories, duration);
  }

  BalanceIs balance_is() const override { return BalanceIs::finite; }
  bool has_histories() const override { return cells_->histories().any(); }
  double follow(const CellMechanics& mechanics, FractureState& state) override;
  double integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state) override;

  CellEnergies energies(const CellMechanics& mechanics, const FractureState& state) const override;
  double driving_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const override;
  double stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const override;
  bool depends_on_strain() const override;
  CellField<Mandel> eigenstrain_moments(const CellMechanics& mechanics, const FractureState& state,
                                        const Vector& plane_normal) const override;
  using CellStiffness::plastic_dissipation;
  double plastic_dissipation(Index cell, const FractureState& from, const FractureState& to) const override;
  Tensor undamaged_stress(Index cell, const CellMechanics& mechanics, const FractureState& state) const override;
  void show(const CellMechanics& mechanics, const FractureState& state, const Vector& plane_normal,
            OutputFields& fields) const override;

 private:
  void give(const FractureState& state, const CellField<double>& g, MomentumSolver& momentum) const override;
  Degraded left(Index cell, const FractureState& state) const {
    return {factor(cell, state.damage[cell]), state.closure[cell]};
  }
  FiniteEnergies energies_of(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
    return cells_->energies(cell, mechanics, left(cell, state), state.histories);
  }
  // psi_plus at the damage d of a cell, with its derivative by d.
  DrivingAt driving_at(Index cell, const FiniteEnergies& at, double d) const;
  double follow_volume(Index cell, const CellMechanics& mechanics, FractureState& state);
  bool descends(Index cell) const override { return cells_->descends(cell); }

  std::unique_ptr<FiniteCells> cells_;
};

}  // namespace pfdm
