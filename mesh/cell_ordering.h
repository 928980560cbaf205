#pragma once
// Orders the cells so that neighbours have close numbers: what a sweep over faces reads is then still in the cache.

#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace pfdm {

/// Reverse Cuthill-McKee order of n cells that meet in the given pairs; entry i is the old number of the i-th cell.
/// Every component starts at a pseudo-peripheral cell (George and Liu, ACM Trans. Math. Softw. 5 (1979) 284).
std::vector<Index> reverse_cuthill_mckee(Index n, const std::vector<std::pair<Index, Index>>& neighbours);

}  // namespace pfdm
