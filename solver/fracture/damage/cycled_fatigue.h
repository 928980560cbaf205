#pragma once
// Fatigue of the cells under a load of cycles: steps that end with parts of a cycle, and jumps.
//
// A jump extrapolates alpha_bar of each cell by its growth over the last whole cycle (explicitly), damage and
// displacement staying as they are; the cycles that follow bring the damage to balance with it. Its length is the
// largest with which f of no cell falls by more than a tolerance.

#include "mesh/mesh.h"
#include "solver/fracture/damage/fatigue_cells.h"

#include <optional>

namespace pfdm {

class CycledFatigue final : public FatigueCells {
 public:
  /// Of a model whose load has cycles.
  using FatigueCells::FatigueCells;

  FatigueState virgin() const override;
  double next_stop(double load, double stop) const override;
  void end_cycle(double load, FatigueState& fatigue) const override;
  double cycles_to_jump(const FractureState& state, double stop) const override;
  void jump(double cycles, DamageEquation& damage, FractureState& state) const override;
  /// The same of the memory and the load alone.
  void jump(double cycles, FractureState& state) const;
  std::optional<FatigueReport> report(const FractureState& state) const override;

 private:
  const FatigueCycles& cycles() const { return model().fatigue_cycles; }
  double largest_fall(const FatigueState& fatigue, double cycles) const;  // of f
};

/// Throws InputError where loads differ between the cycles that jumps leave out; the load ends at `end`.
void require_periodic(const Mesh& mesh, const FractureModel& model, double end);

}  // namespace pfdm
