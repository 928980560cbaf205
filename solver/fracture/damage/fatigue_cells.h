#pragma once
// Fatigue of the cells (physics/damage/fatigue.h): memory, toughness factors, and jumps over cycles of load. alpha_bar
// grows once with each accepted step, by the growth of alpha over the step. So f is that of the step's start, and with
// damage that grows the result has an error of first order in the step. While no damage grows steps that end on the
// peaks of the load are enough.
//
// A jump extrapolates alpha_bar of each cell by its growth over the last whole cycle (explicitly), damage and
// displacement staying as they are; the cycles that follow bring the damage to balance with it. Its length is the
// largest with which f of no cell falls by more than a tolerance.

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include <optional>
#include <string>

namespace pfdm {

class FatigueCells {
 public:
  FatigueCells(const Mesh& mesh, const FractureModel& model);

  bool any() const { return any_; }
  FatigueState virgin() const;
  /// f of each cell [-].
  CellField<double> factors(const FatigueState& fatigue) const;
  /// Takes the memory to the end of a step, at which psi_plus [J/m^3] is degraded by the damage d.
  void accumulate(const CellField<double>& psi_plus, const CellField<double>& d, FatigueState& fatigue) const;
  /// The part of the surface energy that FatigueState::spent counts [J]; exactly 0 while no f has fallen.
  double spent_energy(const FatigueState& fatigue) const;

  /// The next load at which a step has to end: that of a part of a cycle, or `stop`, another that must not be passed,
  /// whichever is first. Two that differ by rounding are one, `stop`.
  double next_stop(double load, double stop) const;
  /// Takes note of a whole cycle, if one ends at this load and has not been counted.
  void end_cycle(double load, FatigueState& fatigue) const;
  /// Number of cycles by which a state may jump: by the tolerance, and so that a whole cycle is left before `stop`, the
  /// next load that must not be passed. 0: the next step goes on as usual.
  double cycles_to_jump(const FractureState& state, double stop) const;
  /// Extrapolates over so many cycles; the load grows by what they take.
  void jump(double cycles, FractureState& state) const;

  FatigueReport report(const FractureState& state) const;
  /// Adds alpha_bar and f to the fields of the output.
  void show(const FatigueState& fatigue, std::vector<OutputHistory>& fields) const;

 private:
  double largest_fall(const FatigueState& fatigue, double cycles) const;  // of f

  const Mesh& mesh_;
  const FractureModel& model_;
  bool any_ = false;
};

/// Watches the energy account of a body with fatigue. A crack that grows at a peak of the load in a single step gives
/// surface energy for which the work of that step is missing.
class FatigueWork {
 public:
  /// The warning after a step to this state: where since the first step that was seen the other energies have
  /// grown by more than the work, and by a tenth of the largest work so far. Empty without fatigue, and once it has
  /// been given.
  std::string remark(const FatigueCells& fatigue, const FractureState& now);

 private:
  std::optional<EnergyAccount> first_;
  double largest_ = 0.0;  // [J]
  bool said_ = false;
};

/// Throws InputError where fatigue, or jumps over cycles, cannot be combined with the rest of the model.
void require_fatigue(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading);

}  // namespace pfdm
