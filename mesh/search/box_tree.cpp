#include "mesh/search/box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace pfdm {
namespace {

constexpr Index leaf_size = 4;

double distance(const Vector& x, const Box& box) { return (x - x.cwiseMax(box.low).cwiseMin(box.high)).norm(); }

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, count_of(order_));
}

Index BoxTree::build(Index first, Index n) {
  Box around = boxes_[order_[first]];
  for (Index i = first; i < first + n; ++i) {
    const Box& box = boxes_[order_[i]];
    around = {around.low.cwiseMin(box.low), around.high.cwiseMax(box.high)};
  }
  const auto node = count_of(nodes_);
  nodes_.push_back({around, first, n});
  if (n <= leaf_size) return node;
  Eigen::Index axis = 0;
  (around.high - around.low).maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  const auto key = [&](Index box) { return std::pair(boxes_[box].low[axis] + boxes_[box].high[axis], box); };
  std::nth_element(begin, begin + n / 2, begin + n, [&](Index a, Index b) { return key(a) < key(b); });
  const Index left = build(first, n / 2), right = build(first + n / 2, n - n / 2);
  nodes_[node].left = left;
  nodes_[node].right = right;
  return node;
}

void BoxTree::search(const Vector& x, const std::function<double(Index box)>& look) const {
  if (nodes_.empty()) return;
  double reach = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, Index>> open{{distance(x, nodes_.front().around), 0}};
  while (!open.empty()) {
    const auto [away, number] = open.back();
    open.pop_back();
    if (!(away < reach)) continue;
    const Node& node = nodes_[number];
    if (node.left < 0) {
      for (Index i = node.first; i < node.first + node.n; ++i)
        if (const Index box = order_[i]; distance(x, boxes_[box]) < reach) reach = look(box);
      continue;
    }
    std::pair<double, Index> near{distance(x, nodes_[node.left].around), node.left},
        far{distance(x, nodes_[node.right].around), node.right};
    if (far.first < near.first) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
}

}  // namespace pfdm
