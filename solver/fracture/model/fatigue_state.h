#pragma once
// What a body remembers of its cycles of load, and how they are gone through: physics/damage/fatigue.h.

#include "mesh/fields.h"

namespace pfdm {

/// Memory of fatigue; without fatigue its fields are empty.
struct FatigueState {
  CellField<double> energy;  ///< alpha_bar of each cell: accumulated driving energy [J/m^3]
  CellField<double> active;  ///< alpha = g(d) psi_plus of each cell at the last step [J/m^3]
  /// Surface energy of each cell that has been dissipated beyond what its damage has at the present toughness, per
  /// volume [J/m^3]: the sum of -gamma df, so that both together are the sum of f dgamma.
  CellField<double> spent;
  CellField<double> cycle_start;   ///< alpha_bar of each cell when the cycle under way began [J/m^3]
  CellField<double> cycle_growth;  ///< of alpha_bar in the last whole cycle [J/m^3]; empty before the first
  Index computed_cycles = 0;       ///< whole ones since the start, or since the last jump
  double whole_cycles = 0.0;       ///< up to the last that was counted, those of jumps included
  double jumped_cycles = 0.0;      ///< over which alpha_bar was extrapolated, since the start
  friend bool operator==(const FatigueState&, const FatigueState&) = default;
};

/// The cycles of the load of a body with fatigue.
struct FatigueCycles {
  double cycle = 0.0;           ///< load parameter that a cycle takes; 0: the load has no cycles
  Index steps = 4;              ///< equal parts of a cycle; a step ends with each
  double jump_tolerance = 0.0;  ///< largest fall of f in a cell by a jump [-]; 0: no jumps
  Index computed_cycles = 2;    ///< least number of whole cycles before and between jumps

  bool any() const { return cycle > 0.0; }
};

/// Report of a body with fatigue.
struct FatigueReport {
  double cycles = 0.0;           ///< that the load has gone through, those of jumps included; 0 without cycles
  double jumped_cycles = 0.0;    ///< of them those of jumps
  double greatest_energy = 0.0;  ///< alpha_bar over its threshold, largest in a cell [-]
  double least_factor = 1.0;     ///< f, smallest in a cell [-]
};

}  // namespace pfdm
