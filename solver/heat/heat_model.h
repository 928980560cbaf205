#pragma once
// What heat does in a body that deforms, besides conductivity and capacity of its regions. Temperatures are rises above
// that of the start, at which nothing flows.

#include "physics/tensor.h"
#include "solver/scalar/diffusion_boundary.h"

#include <limits>
#include <vector>

namespace pfdm {

struct HeatModel {
  std::vector<DiffusionBoundary> boundary{};  ///< patches that are not named are insulated
  double debonding_share = 1.0;               ///< of what decohesion dissipates, the rest being surface energy
  /// Conductance of interfaces that are bonded or touch, and of those that have come off [W/(m^2 K)].
  double closed_conductance = std::numeric_limits<double>::infinity(), open_conductance = 0.0;
  double cycle = 0.0;  ///< of the load parameter; 0: the load has no cycles
  double repeats_within =
      0.01;                ///< change of a cycle's heat, summed over the cells, from which on it repeats; relative
  double time = 0.0;       ///< that the mean heat of a cycle warms the body [s]; 0: not looked at
  Index time_steps = 100;  ///< in which it is gone through
  /// Rises strain what expands, and shift the times of materials that depend on the temperature. With cycles and a time
  /// the cycle is gone through again once shear moduli, real or imaginary part, or its heat have changed by this share.
  bool is_two_way = false;
  double changes_within = 0.02;
};

/// Whether cycles of load are gone through again and again while the long time goes by.
inline bool follows_long_time(const HeatModel& heat) { return heat.is_two_way && heat.cycle > 0.0 && heat.time > 0.0; }

}  // namespace pfdm
