#pragma once
// The mean derivative over a cell, from slopes between the places of a line through it.

#include "physics/tensor.h"

#include <array>
#include <span>
#include <vector>

namespace pfdm {

/// Place of a slope of a line, from the middle of the cell and over the cell's length. At the end of a line some
/// components may be held: their slope is half-way to the face, that of the free ones, whose traction is known, at it.
struct LinePlace {
  double at = 0.0, at_held = 0.0;
  Tensor held = Tensor::Zero();  ///< the held components, as a projection
};

struct LineWeights {
  /// Difference of the weights of some components from those of all.
  struct Change {
    Tensor part;
    std::array<double, 4> change;
  };
  std::array<double, 4> of_all{};
  std::vector<Change> of_held;
};

/// Weights of up to four slopes in the mean over the cell, [-1/2, 1/2], of the polynomial through them.
LineWeights line_weights(std::span<const LinePlace> places);

}  // namespace pfdm
