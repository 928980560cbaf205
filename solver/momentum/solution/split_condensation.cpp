#include "solver/momentum/solution/split_condensation.h"

#include "solver/parallel.h"

#include <Eigen/LU>

namespace pfdm {

SplitCondensation::SplitCondensation(const Mesh& mesh, const Unknowns& unknowns) : place_(unknowns.n_nodes(), 0) {
  for (const Index f : unknowns.split_faces) {
    const Index first = -1 - 2 * count_of(pairs_);
    const Pair pair{.node = {unknowns.node_of_face[f], unknowns.neighbour_node[f]},
                    .cell = {mesh.owner[f], mesh.neighbour[f]},
                    .to_cell = {},
                    .inverse = {}};
    place_[pair.node[0]] = first;
    place_[pair.node[1]] = first - 1;
    pairs_.push_back(pair);
  }
  for (Index i = 0; i < unknowns.n_nodes(); ++i) {
    if (place_[i] < 0) continue;
    place_[i] = count_of(kept_);
    kept_.push_back(i);
  }
}

void SplitCondensation::begin(const BlockTriplets& whole) {
  for (Pair& pair : pairs_) {
    pair.to_cell = {Tensor::Zero(), Tensor::Zero()};
    pair.inverse.setZero();
    for (const int side : {0, 1}) pair.inverse.block<3, 3>(3 * side, 3 * side) = whole.diagonal[pair.node[side]];
  }
}

BlockTriplets SplitCondensation::condense(const BlockTriplets& whole) {
  begin(whole);
  BlockTriplets rest;
  rest.diagonal.reserve(kept_.size());
  for (const Index i : kept_) rest.diagonal.push_back(whole.diagonal[i]);
  for (const BlockTriplets::Entry& entry : whole.off_diagonal) {
    const Index row = place_[entry.row], column = place_[entry.column];
    if (row >= 0 && column >= 0) {
      rest.off_diagonal.push_back({row, column, entry.value});
      continue;
    }
    const Index eliminated = -1 - (row < 0 ? row : column), side = eliminated % 2;
    Pair& pair = pairs_[eliminated / 2];
    if (row < 0 && column < 0) {
      pair.inverse.block<3, 3>(3 * side, 3 - 3 * side) += entry.value;
      pair.inverse.block<3, 3>(3 - 3 * side, 3 * side) += entry.value.transpose();
    } else {
      pair.to_cell[side] += row < 0 ? Tensor(entry.value.transpose()) : entry.value;
    }
  }
  for (Pair& pair : pairs_) {
    pair.inverse = pair.inverse.inverse().eval();
    const auto& [A, B] = pair.to_cell;
    const std::array<Index, 2> cell{place_[pair.cell[0]], place_[pair.cell[1]]};
    rest.diagonal[cell[0]] -= A * pair.inverse.topLeftCorner<3, 3>() * A.transpose();
    rest.diagonal[cell[1]] -= B * pair.inverse.bottomRightCorner<3, 3>() * B.transpose();
    rest.off_diagonal.push_back({cell[0], cell[1], -A * pair.inverse.topRightCorner<3, 3>() * B.transpose()});
  }
  return rest;
}

SplitCondensation::Both SplitCondensation::right_side(const Pair& pair, const std::vector<Vector>& r) const {
  return (Both() << r[pair.node[0]], r[pair.node[1]]).finished();
}

void SplitCondensation::condense(const std::vector<Vector>& whole, std::vector<Vector>& of_kept) const {
  of_kept.resize(kept_.size());
  parallel_for(count_of(kept_), [&](Index k) { of_kept[k] = whole[kept_[k]]; });
  for (const Pair& pair : pairs_) {
    const Both alone = pair.inverse * right_side(pair, whole);
    of_kept[place_[pair.cell[0]]] -= pair.to_cell[0] * alone.head<3>();
    of_kept[place_[pair.cell[1]]] -= pair.to_cell[1] * alone.tail<3>();
  }
}

void SplitCondensation::expand(const std::vector<Vector>& of_kept, const std::vector<Vector>& r,
                               std::vector<Vector>& z) const {
  parallel_for(count_of(kept_), [&](Index k) { z[kept_[k]] = of_kept[k]; });
  parallel_for(count_of(pairs_), [&](Index k) {
    const Pair& pair = pairs_[k];
    Both right = right_side(pair, r);
    right.head<3>() -= pair.to_cell[0].transpose() * z[pair.cell[0]];
    right.tail<3>() -= pair.to_cell[1].transpose() * z[pair.cell[1]];
    const Both both = pair.inverse * right;
    z[pair.node[0]] = both.head<3>();
    z[pair.node[1]] = both.tail<3>();
  });
}

}  // namespace pfdm
