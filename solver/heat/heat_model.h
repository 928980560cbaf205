#pragma once
// What heat does in a body that deforms, besides conductivity and capacity of its regions. Temperatures are rises above
// that of the start, at which nothing flows.

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
      0.01;  ///< change of a cycle's heat, summed over the cells, from which on it repeats; relative
};

}  // namespace pfdm
