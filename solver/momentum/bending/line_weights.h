#pragma once
// The mean derivative over a cell, from slopes between the places of a line through it.

#include "physics/tensor.h"

#include <array>
#include <span>
#include <vector>

namespace pfdm {

/// Where a slope of a line is, from the middle of the cell and over the cell's length. At the end of a line some
/// components may be held: their slope is half-way to the face, that of the free ones, whose traction is known, at it.
struct LinePlace {
  double at = 0.0, at_held = 0.0;
  Tensor held = Tensor::Zero();  ///< the held components, as a projection
};

struct LineWeights {
  /// By what the weights of some components differ.
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
