#include "solver/linear/aggregation.h"

#include "mesh/fields.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

void invert_diagonal(BlockMatrix& matrix) {
  matrix.inverse_diagonal.resize(matrix.diagonal.size());
  parallel_for(matrix.n_rows(),
               [&](Index i) { matrix.inverse_diagonal[i] = to_block(to_tensor(matrix.diagonal[i]).inverse()); });
}

// Scalar couplings -trace(a_ij) for the matching, in compressed rows.
struct Couplings {
  std::vector<Index> offsets{0};
  std::vector<Index> columns;
  std::vector<float> strength;

  Index n_rows() const { return count_of(offsets) - 1; }
};

Couplings couplings_of(const BlockMatrix& matrix) {
  Couplings c{.offsets = matrix.offsets, .columns = matrix.columns, .strength = {}};
  c.strength.resize(matrix.blocks.size());
  for (std::size_t k = 0; k < matrix.blocks.size(); ++k) {
    const Block& b = matrix.blocks[k];
    c.strength[k] = -(b.column[0][0] + b.column[1][1] + b.column[2][2]);
  }
  return c;
}

// Each row with its most strongly coupled free neighbour, if that coupling is not weak against its strongest; rows that
// find none join the pair of their strongest neighbour, one to a pair, or also all those that hang on this neighbour
// alone: the smoother is exact for them. A row whose strongest neighbours are all taken stays alone before it joins one
// that hardly holds it: an aggregate across a broken layer would tie the bodies on its sides to each other, and the
// motion of one against the other would be left to the smoother.
enum class Joining { one_to_a_pair, all_that_hang };
std::vector<Index> match_pairs(const Couplings& couplings, Joining joining, Index& count) {
  constexpr float weak = 0.25F, hardly = 0.01F;  // of a row's strongest coupling
  constexpr Index none = -1;
  std::vector<Index> pair_of(couplings.n_rows(), none), size_of_pair;
  const auto strongest_neighbour = [&](Index i, const auto& qualifies) {
    std::pair<Index, float> best{none, 0.0F};
    for (Index k = couplings.offsets[i]; k < couplings.offsets[i + 1]; ++k)
      if (couplings.strength[k] > best.second && qualifies(couplings.columns[k]))
        best = {couplings.columns[k], couplings.strength[k]};
    return best;
  };
  for (Index i = 0; i < couplings.n_rows(); ++i) {
    if (pair_of[i] != none) continue;
    const float strongest = strongest_neighbour(i, [](Index) { return true; }).second;
    if (strongest == 0.0F) continue;
    const auto [partner, strength] = strongest_neighbour(i, [&](Index j) { return pair_of[j] == none && j != i; });
    if (partner != none && strength >= weak * strongest) {
      pair_of[i] = pair_of[partner] = count_of(size_of_pair);
      size_of_pair.push_back(2);
      continue;
    }
    const bool hangs = joining == Joining::all_that_hang && couplings.offsets[i + 1] - couplings.offsets[i] == 1;
    const auto [nearest, hold] = strongest_neighbour(i, [&](Index j) {
      const Index pair = pair_of[j];
      return pair != none && (hangs || size_of_pair[pair] <= 2);
    });
    const Index host = hold >= hardly * strongest ? nearest : none;
    pair_of[i] = host != none ? pair_of[host] : count_of(size_of_pair);
    if (host != none)
      ++size_of_pair[pair_of[host]];
    else
      size_of_pair.push_back(1);
  }
  count = count_of(size_of_pair);
  return pair_of;
}

// Rows of each aggregate, in compressed form.
struct Members {
  std::vector<Index> offsets, rows;
};

Members members_of(const std::vector<Index>& aggregate_of, Index count) {
  Members m{.offsets = std::vector<Index>(count + 1, 0), .rows = {}};
  for (const Index a : aggregate_of)
    if (a >= 0) ++m.offsets[a + 1];
  for (std::size_t a = 0; a < as_size(count); ++a) m.offsets[a + 1] += m.offsets[a];
  m.rows.resize(m.offsets.back());
  std::vector<Index> next(m.offsets.begin(), m.offsets.end() - 1);
  for (std::size_t i = 0; i < aggregate_of.size(); ++i)
    if (aggregate_of[i] >= 0) m.rows[next[aggregate_of[i]]++] = static_cast<Index>(i);
  return m;
}

template <class Value>
struct Gathered {
  std::vector<Index> offsets{0}, columns;
  std::vector<Value> values;
};

// Adds up the entries of each aggregate's rows by the aggregate of their column; those without one go to `left_out`.
template <class Value>
Gathered<Value> gather(const std::vector<Index>& offsets, const std::vector<Index>& columns,
                       const std::vector<Value>& values, const std::vector<Index>& aggregate_of, Index count,
                       std::vector<Value>* left_out) {
  const Members members = members_of(aggregate_of, count);
  Gathered<Value> result;
  std::vector<Index> slot(count, -1);
  for (Index a = 0; a < count; ++a) {
    const std::size_t row_begin = result.columns.size();
    for (Index m = members.offsets[a]; m < members.offsets[a + 1]; ++m) {
      const std::size_t i = members.rows[m];
      for (Index k = offsets[i]; k < offsets[i + 1]; ++k) {
        const Index to = aggregate_of[columns[k]];
        if (to < 0 && left_out != nullptr) (*left_out)[a] += values[k];
        if (to < 0 || to == a) continue;
        if (slot[to] < 0) {
          slot[to] = count_of(result.columns);
          result.columns.push_back(to);
          result.values.push_back(values[k]);
        } else {
          result.values[slot[to]] += values[k];
        }
      }
    }
    for (std::size_t k = row_begin; k < result.columns.size(); ++k) slot[result.columns[k]] = -1;
    result.offsets.push_back(count_of(result.columns));
  }
  return result;
}

Aggregates aggregate(const BlockMatrix& matrix, int n_passes, Joining joining) {
  Couplings couplings = couplings_of(matrix);
  Aggregates result;
  result.of_row = match_pairs(couplings, joining, result.count);
  std::vector<Index> last = result.of_row;
  for (int pass = 1; pass < n_passes; ++pass) {
    auto gathered =
        gather<float>(couplings.offsets, couplings.columns, couplings.strength, last, result.count, nullptr);
    couplings = {std::move(gathered.offsets), std::move(gathered.columns), std::move(gathered.values)};
    const Index before = result.count;
    last = match_pairs(couplings, joining, result.count);
    // An aggregate that has no coupling left stays one by itself.
    for (Index a = 0; a < before; ++a)
      if (last[a] < 0) last[a] = result.count++;
    for (Index& a : result.of_row)
      if (a >= 0) a = last[a];
  }
  return result;
}

}  // namespace

BlockMatrix compress(const BlockTriplets& triplets, const std::vector<Index>& position_of_node) {
  BlockMatrix matrix;
  const std::size_t n = triplets.diagonal.size();
  matrix.diagonal.resize(n);
  for (std::size_t i = 0; i < n; ++i) matrix.diagonal[position_of_node[i]] = to_block(triplets.diagonal[i]);
  matrix.offsets.assign(n + 1, 0);
  for (const auto& entry : triplets.off_diagonal) {
    ++matrix.offsets[position_of_node[entry.row] + 1];
    ++matrix.offsets[position_of_node[entry.column] + 1];
  }
  for (std::size_t i = 0; i < n; ++i) matrix.offsets[i + 1] += matrix.offsets[i];
  matrix.columns.resize(matrix.offsets.back());
  matrix.blocks.resize(matrix.offsets.back());
  std::vector<Index> next(matrix.offsets.begin(), matrix.offsets.end() - 1);
  const auto put = [&](Index row, Index column, const Tensor& value) {
    const std::size_t slot = next[row]++;
    matrix.columns[slot] = column;
    matrix.blocks[slot] = to_block(value);
  };
  std::vector<Tensor> row_sum = triplets.diagonal;
  for (const auto& entry : triplets.off_diagonal) {
    const Index row = position_of_node[entry.row], column = position_of_node[entry.column];
    put(row, column, entry.value);
    put(column, row, entry.value.transpose());
    row_sum[entry.row] += entry.value;
    row_sum[entry.column] += entry.value.transpose();
  }
  matrix.row_sum.resize(n);
  for (std::size_t i = 0; i < n; ++i) matrix.row_sum[position_of_node[i]] = to_block(row_sum[i]);
  invert_diagonal(matrix);
  return matrix;
}

// On the free sides of plates most nodes hang on one cell, and the cells do not have room for them.
Aggregates aggregate(const BlockMatrix& matrix, int n_passes) {
  Aggregates result = aggregate(matrix, n_passes, Joining::one_to_a_pair);
  const bool stalls = result.count > matrix.n_rows() / 4;
  return stalls ? aggregate(matrix, n_passes, Joining::all_that_hang) : result;
}

// Within an aggregate the entries cancel: what is left of the diagonal is the rows' sums and the couplings to others.
BlockMatrix coarsen(const BlockMatrix& matrix, const Aggregates& aggregates) {
  BlockMatrix coarse;
  std::vector<Block> left_out(aggregates.count);
  auto gathered =
      gather<Block>(matrix.offsets, matrix.columns, matrix.blocks, aggregates.of_row, aggregates.count, &left_out);
  coarse.offsets = std::move(gathered.offsets);
  coarse.columns = std::move(gathered.columns);
  coarse.blocks = std::move(gathered.values);
  coarse.row_sum.resize(aggregates.count);
  for (std::size_t i = 0; i < aggregates.of_row.size(); ++i)
    if (const Index to = aggregates.of_row[i]; to >= 0) coarse.row_sum[to] += matrix.row_sum[i];
  for (std::size_t i = 0; i < left_out.size(); ++i) coarse.row_sum[i] -= left_out[i];
  coarse.diagonal = coarse.row_sum;
  for (Index i = 0; i < aggregates.count; ++i)
    for (Index k = coarse.offsets[i]; k < coarse.offsets[i + 1]; ++k) coarse.diagonal[i] -= coarse.blocks[k];
  invert_diagonal(coarse);
  return coarse;
}

}  // namespace pfdm
