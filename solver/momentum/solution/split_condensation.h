#pragma once
// Static condensation of the nodes of split faces (cohesive interfaces) from the compact matrix. The two nodes of a
// face are coupled with each other and with their own cells alone, so that they are eliminated exactly. Multigrid then
// sees two cells in series with the spring of the face. Its smoother, which takes one node at a time, hardly moves two
// nodes that a spring stiffer than the cells ties together.

#include "mesh/mesh.h"
#include "solver/linear/block_matrix.h"
#include "solver/momentum/body/unknowns.h"

#include <array>
#include <vector>

namespace pfdm {

class SplitCondensation {
 public:
  SplitCondensation(const Mesh& mesh, const Unknowns& unknowns);

  /// The nodes that stay, in ascending order: cells, and nodes of other faces.
  const std::vector<Index>& kept() const { return kept_; }
  /// The matrix of the nodes that stay, in the order of kept(), from that of all nodes.
  BlockTriplets condense(const BlockTriplets& whole);
  /// Their right side, from that of all nodes.
  void condense(const std::vector<Vector>& whole, std::vector<Vector>& of_kept) const;
  /// Sets z at all nodes: to the solution at the nodes that stay, and to what follows from it and from the right side r
  /// at the others.
  void expand(const std::vector<Vector>& of_kept, const std::vector<Vector>& r, std::vector<Vector>& z) const;

 private:
  using Both = Eigen::Matrix<double, 6, 1>;  // nodes of a face
  struct Pair {
    std::array<Index, 2> node, cell;
    std::array<Tensor, 2> to_cell;        // block of the cell's row and the node's column
    Eigen::Matrix<double, 6, 6> inverse;  // of the block of both nodes
  };
  void begin(const BlockTriplets& whole);
  Both right_side(const Pair& pair, const std::vector<Vector>& r) const;

  std::vector<Pair> pairs_;
  std::vector<Index> kept_;
  std::vector<Index> place_;  // of each node in kept_; of those of pair k: -1 - 2 k - side
};

}  // namespace pfdm
