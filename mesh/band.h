#pragma once

#include <array>
#include <string>

namespace pfdm {

/// A thin band between two regions, as the layers around a particle are.
struct Band {
  std::string region;
  double width = 0.0;                     ///< [m]
  std::array<std::string, 2> neighbours;  ///< regions
};

}  // namespace pfdm
