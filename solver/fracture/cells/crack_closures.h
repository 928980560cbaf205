#pragma once
// How the closure of broken cells follows their strain within a load step. Closure: 1 where a crack is closed and keeps
// a part of the stiffness, 0 where it is open.

#include "mesh/fields.h"

#include <vector>

namespace pfdm {

/// Cells at the edge of a crack would open and close for ever if their closures jumped. Their strides, in the logarithm
/// of the kept stiffness, are halved at each reversal and grow again in between (as in Riedmiller, Braun, IEEE Int.
/// Conf. Neural Networks (1993) 586).
class CrackClosures {
 public:
  void start_step(Index n_cells);
  /// The next closure of a cell whose stiffness factor is g, and whose strain asks for `wanted`, 0 or 1.
  double next(Index cell, double g, double closure, double wanted);
  /// Broken cells whose cracks the last next() has opened or closed. Their energy may be small and what they hold back
  /// large, as the last closed cell of a row. Cells that go to and fro do not count.
  std::vector<Index> moving() const;

 private:
  CellField<float> lags_;     // the last one that was not 0
  CellField<float> strides_;  // of the next move, over the range from g to 1
  CellField<Index> turns_;    // number of reversals
  CellField<char> moves_;     // whether the crack opens or closes
};

}  // namespace pfdm
