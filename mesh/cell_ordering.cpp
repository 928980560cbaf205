#include "mesh/cell_ordering.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace pfdm {
namespace {

class CellGraph {
 public:
  CellGraph(Index n, const std::vector<std::pair<Index, Index>>& neighbours)
      : offsets_(static_cast<std::size_t>(n) + 1, 0),
        list_(2 * neighbours.size()),
        stamp_(static_cast<std::size_t>(n), 0) {
    for (const auto& [a, b] : neighbours) {
      ++offsets_[a + 1];
      ++offsets_[b + 1];
    }
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    std::vector<Index> fill(offsets_.begin(), offsets_.end() - 1);
    for (const auto& [a, b] : neighbours) {
      list_[fill[a]++] = b;
      list_[fill[b]++] = a;
    }
    for (Index c = 0; c < n; ++c)
      std::sort(list_.begin() + offsets_[c], list_.begin() + offsets_[c + 1],
                [this](Index a, Index b) { return std::pair(degree(a), a) < std::pair(degree(b), b); });
  }

  Index degree(Index c) const { return offsets_[c + 1] - offsets_[c]; }

  /// Breadth-first from start, neighbours by degree; returns the cells met and the first cell of the last level.
  std::vector<Index> levels_from(Index start, Index& depth, std::size_t& last_level) {
    ++round_;
    std::vector<Index> met{start};
    stamp_[start] = round_;
    depth = 0;
    last_level = 0;
    for (std::size_t i = 0, level_end = 1; i < met.size(); ++i) {
      if (i == level_end) {
        ++depth;
        last_level = i;
        level_end = met.size();
      }
      for (Index k = offsets_[met[i]]; k < offsets_[met[i] + 1]; ++k)
        if (stamp_[list_[k]] != round_) {
          stamp_[list_[k]] = round_;
          met.push_back(list_[k]);
        }
    }
    return met;
  }

 private:
  std::vector<Index> offsets_;
  std::vector<Index> list_;
  std::vector<Index> stamp_;  // the last round in which a cell was met
  Index round_ = 0;
};

// Restarts from the far end of the level structure until that makes it no deeper.
std::vector<Index> cuthill_mckee_component(CellGraph& graph, Index seed) {
  Index depth = 0;
  std::size_t last_level = 0;
  std::vector<Index> best = graph.levels_from(seed, depth, last_level);
  for (bool deeper = true; deeper;) {
    const Index far = *std::min_element(best.begin() + last_level, best.end(),
                                        [&](Index a, Index b) { return graph.degree(a) < graph.degree(b); });
    Index new_depth = 0;
    std::size_t new_last = 0;
    std::vector<Index> trial = graph.levels_from(far, new_depth, new_last);
    deeper = new_depth > depth;
    if (!deeper) break;
    best = std::move(trial);
    depth = new_depth;
    last_level = new_last;
  }
  return best;
}

}  // namespace

std::vector<Index> reverse_cuthill_mckee(Index n, const std::vector<std::pair<Index, Index>>& neighbours) {
  CellGraph graph(n, neighbours);
  std::vector<Index> order;
  order.reserve(n);
  std::vector<bool> placed(n, false);
  for (Index seed = 0; seed < n; ++seed) {
    if (placed[seed]) continue;
    for (const Index c : cuthill_mckee_component(graph, seed)) {
      placed[c] = true;
      order.push_back(c);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace pfdm
