#pragma once
// What a body remembers of its heat: a value like the rest of the state.

#include "mesh/fields.h"

#include <limits>
#include <vector>

namespace pfdm {

/// Since the start [J]: made = stored + lost to within the solver's residual.
struct HeatBalance {
  double made = 0.0;    ///< by what the body dissipates
  double stored = 0.0;  ///< capacity times the rise, over the volume
  double lost = 0.0;    ///< through the surface
  friend bool operator==(const HeatBalance&, const HeatBalance&) = default;
};

struct HeatState {
  CellField<double> rise;  ///< of each cell [K]; empty without heat
  CellField<double>
      made;  ///< in each cell since the last whole cycle or the start, its part of interfaces included [J]
  CellField<double> cycle;                  ///< likewise in the last whole cycle [J]; empty before
  std::vector<double> transmitted;          ///< time integral of each interface face's transmittance [J/(m^2 K)]
  std::vector<double> cycle_transmittance;  ///< its mean in the last whole cycle [W/(m^2 K)]
  double cycle_change =
      std::numeric_limits<double>::infinity();  ///< of the cycles' heat from the last but one, relative
  HeatBalance account{};
  double duration = 0.0;        ///< of the load parameter's 1, by which these times were made [s]
  double elapsed = 0.0;         ///< since the start, with the times that cycles stood for [s]
  CellField<double> stood_for;  ///< heat of the cycle that last stood for a time [J]; empty before, and one-way
  double stretch = 0.0;         ///< that time [s]
  CellField<double> felt;       ///< rises by which the last step was solved [K]; empty one-way
  friend bool operator==(const HeatState&, const HeatState&) = default;
};

/// The rises of a body now.
struct HeatFigures {
  double greatest = 0.0;          ///< [K]
  double mean = 0.0;              ///< stored heat over the capacity of the whole body [K]
  Vector place = Vector::Zero();  ///< centre of the cell with the greatest rise [m]
};

/// After a time under a source that stays.
struct HeatRow {
  double time = 0.0;  ///< [s]
  HeatFigures figures{};
  HeatBalance account{};
};

}  // namespace pfdm
