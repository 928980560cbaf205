#pragma once
// Sets that are joined two by two (union-find, with path halving). The least member of a set stands for it, so that the
// numbering of sets by their first members does not depend on the order of joining.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace pfdm {

class DisjointSets {
 public:
  /// n sets of one member each.
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  /// The least member of the set that i is in.
  std::size_t least_with(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(std::size_t i, std::size_t j) {
    const auto [low, high] = std::minmax({least_with(i), least_with(j)});
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace pfdm
