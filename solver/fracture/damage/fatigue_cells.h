#pragma once
// Fatigue of the cells (physics/damage/fatigue.h): memory and toughness factors. alpha_bar grows once with each
// accepted step, by the growth of alpha over the step. So f is that of the step's start, and with damage that grows the
// result has an error of first order in the step. While no damage grows steps that end on the peaks of the load are
// enough.

#include "mesh/mesh.h"
#include "solver/fracture/damage/body_fatigue.h"
#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Whether the cells of a region tire.
bool has_fatigue(const RegionModel& region);
bool has_fatigue(const Mesh& mesh, const FractureModel& model);  ///< those of any

class FatigueCells : public BodyFatigue {
 public:
  FatigueCells(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {}

  FatigueState virgin() const override;
  void set_toughness(const FractureState& state, DamageEquation& damage) const override {
    damage.set_toughness_factor(factors(state.fatigue), state.damage);
  }
  void end_step(const CellField<double>& psi_plus, DamageEquation& damage, FractureState& state) const override;
  double spent_energy(const FatigueState& fatigue) const override;
  void add_spent(const FatigueState& fatigue, CellField<double>& density) const override;

  std::optional<FatigueReport> report(const FractureState& state) const override;
  std::string remark(FatigueWork& work, const FractureState& state) const override;
  void show(const FatigueState& fatigue, std::vector<OutputHistory>& fields) const override;

 protected:
  CellField<double> factors(const FatigueState& fatigue) const;  // f of each cell [-]
  void lower_toughness(DamageEquation& damage, FractureState& state) const;
  const Mesh& mesh() const { return mesh_; }
  const FractureModel& model() const { return model_; }

 private:
  const Mesh& mesh_;
  const FractureModel& model_;
};

/// Watches the energy account of a body with fatigue. A crack that grows at a peak of the load in a single step gives
/// surface energy for which the work of that step is missing.
class FatigueWork {
 public:
  /// The warning after a step to this state: where since the first step that was seen the other energies have
  /// grown by more than the work, and by a tenth of the largest work so far. Empty once it has been given.
  std::string remark(const FractureState& now);

 private:
  std::optional<EnergyAccount> first_;
  double largest_ = 0.0;  // [J]
  bool said_ = false;
};

/// Throws InputError where fatigue, or jumps over cycles, cannot be combined with the rest of the model.
void require_fatigue(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading);

}  // namespace pfdm
