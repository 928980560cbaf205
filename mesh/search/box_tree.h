#pragma once
// Boxes in a binary tree, for what is next to a point.

#include <functional>
#include <vector>

#include "mesh/bounding_box.h"

namespace pfdm {

/// A binary tree of boxes, halved at the median along the longest side of what it encloses. The order of a search
/// depends on the boxes alone.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls `look` with the numbers of boxes nearer to x than what it returned last (first: all), nearer branches first.
  void search(const Vector& x, const std::function<double(Index box)>& look) const;

 private:
  struct Node {
    Box around;
    Index first, n;               // of order_
    Index left = -1, right = -1;  // -1: a leaf
  };
  Index build(Index first, Index n);

  std::vector<Box> boxes_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace pfdm
