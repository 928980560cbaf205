#pragma once
// Scalar products whose additions have one order, whatever the width of the processor's vectors.

#include "physics/tensor.h"

#include <numeric>

namespace pfdm {

/// Sum of a_i b_i, i < n: sixteen partial sums side by side, then these in turn, all in the precision of T.
template <class T>
T ordered_dot(const T* a, const T* b, Index n) {
  constexpr Index width = 16;
  using Lanes = Eigen::Array<T, width, 1>;
  Lanes sums = Lanes::Zero();
  const Index whole = n - n % width;
  for (Index i = 0; i < whole; i += width) sums += Eigen::Map<const Lanes>(a + i) * Eigen::Map<const Lanes>(b + i);
  for (Index i = whole; i < n; ++i) sums[i - whole] += a[i] * b[i];
  return std::accumulate(sums.data(), sums.data() + width, T{});
}

}  // namespace pfdm
