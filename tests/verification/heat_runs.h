#pragma once
// Runs in equal steps of time, and bodies that warm.

#include "tests/verification/support.h"

#include <utility>

namespace pfdm::verification {

/// Equal steps of the load parameter, which grows by 1 in `duration` [s].
inline LoadingSettings in_steps(double end, double step, double duration, double least = 1e-9) {
  return {.end = end,
          .initial_increment = step,
          .minimum_increment = least,
          .maximum_increment = step,
          .duration = duration,
          .stops = {},
          .is_proportional = false};
}

/// Cycles of the load, each of this period [s].
inline LoadingSettings cycles(double most, int steps_each, double period) {
  return in_steps(most, 1.0 / steps_each, period, 1e-6);
}

/// k = 0.2 W/(m K), c = 1500 J/(kg K), rho = 1000 kg/m^3 everywhere.
inline void give_heat(FractureModel& model, HeatModel heat) {
  for (RegionModel& region : model.regions)
    region.conductivity = 0.2, region.specific_heat = 1500.0, region.density = 1000.0;
  model.heat = std::move(heat);
}

}  // namespace pfdm::verification
