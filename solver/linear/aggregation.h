#pragma once
// Aggregates of strongly coupled nodes, by repeated pairwise matching (Notay, ETNA 37 (2010) 123), and the coarse
// matrix of piecewise constant displacement on them.

#include "solver/linear/block_matrix.h"

#include <vector>

namespace pfdm {

/// Rows in the order given, from triplets in node numbers; position_of_node maps nodes to rows.
BlockMatrix compress(const BlockTriplets& triplets, const std::vector<Index>& position_of_node);

/// Aggregate of every row; -1 for rows without couplings, which only the smoother treats. Aggregates are numbered by
/// their first row. They have 2^n_passes rows in general; rows without a partner join others, so some are larger.
struct Aggregates {
  std::vector<Index> of_row;
  Index count = 0;
};
Aggregates aggregate(const BlockMatrix& matrix, int n_passes);

/// Galerkin product of a matrix with the aggregates' indicator functions.
BlockMatrix coarsen(const BlockMatrix& matrix, const Aggregates& aggregates);

}  // namespace pfdm
