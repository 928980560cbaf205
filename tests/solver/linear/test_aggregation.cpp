// How multigrid puts rows together: the Galerkin product, dangling nodes, layers that are broken.

#include "solver/linear/fgmres.h"
#include "solver/linear/multigrid.h"
#include "solver/momentum/momentum.h"
#include "tests/solver/block_problems.h"
#include "tests/solver/solver_checks.h"

#include <utility>
#include <vector>

namespace pfdm::this_file {
namespace {

using Multigrids = WithThreads;

// The Galerkin product with indicator functions: the same energy for vectors that are constant on each aggregate.
TEST_F(Multigrids, CoarseMatrixIsTheGalerkinProduct) {
  const BlockMatrix fine = compress(elastic_problem(6), in_order(216 + 216));
  const Aggregates aggregates = aggregate(fine, 3);
  const BlockMatrix coarse = coarsen(fine, aggregates);
  ASSERT_EQ(coarse.n_rows(), aggregates.count);
  RandomNumbers random;
  std::vector<Lane> x(aggregates.count, Lane::Zero()), prolonged(fine.diagonal.size(), Lane::Zero());
  for (Lane& v : x) v.head<3>() = random.vector().cast<float>();
  for (std::size_t i = 0; i < prolonged.size(); ++i)
    if (aggregates.of_row[i] >= 0) prolonged[i] = x[aggregates.of_row[i]];
  const auto energy = [](const BlockMatrix& a, const std::vector<Lane>& v) {
    double sum = 0.0;
    for (Index i = 0; i < a.n_rows(); ++i) {
      Lane image = a.diagonal[i] * v[i];
      for (Index k = a.offsets[i]; k < a.offsets[i + 1]; ++k) image += a.blocks[k] * v[a.columns[k]];
      sum += double((image * v[i]).sum());
    }
    return sum;
  };
  EXPECT_NEAR(energy(coarse, x) / energy(fine, prolonged), 1.0, 1e-4);
}

// A chain of cells with two dangling face nodes each, as a thin bar between symmetry planes has them. Nodes that hang
// on one cell alone must join it, or coarsening stalls and the "coarsest" level is solved densely.
void expect_coarsened_with_dangling_nodes(double coupling) {
  constexpr Index cells = 500;
  BlockTriplets a;
  a.diagonal.assign(3 * cells, 1e-3 * Tensor::Identity());
  const auto couple = [&](Index i, Index j, double stiffness) {
    a.diagonal[i] += stiffness * Tensor::Identity();
    a.diagonal[j] += stiffness * Tensor::Identity();
    a.off_diagonal.push_back({i, j, -stiffness * Tensor::Identity()});
  };
  for (Index c = 0; c < cells; ++c) {
    if (c > 0) couple(3 * c - 3, 3 * c, 1.0);
    couple(3 * c, 3 * c + 1, coupling);
    couple(3 * c, 3 * c + 2, coupling);
  }
  const BlockMatrix fine = compress(a, in_order(3 * cells));
  const Aggregates first = aggregate(fine, 3);
  EXPECT_LE(first.count, fine.n_rows() / 4);
  const BlockMatrix coarse = coarsen(fine, first);
  EXPECT_LE(aggregate(coarse, 3).count, coarse.n_rows() / 4);
}

TEST_F(Multigrids, DanglingNodesDoNotStallTheCoarsening) {
  expect_coarsened_with_dangling_nodes(1.0);
  expect_coarsened_with_dangling_nodes(1e-3);  // of a plate that is thick against the width of its cells
}

// Two grids of rows, numbered at random and joined by a layer a million times weaker than they are.
struct TwoBodies {
  BlockTriplets matrix;
  std::vector<Index> body_of_row;
};

TwoBodies two_bodies(Index edge, RandomNumbers& random) {
  std::vector<Index> number = in_order(2 * edge * edge);
  for (std::size_t i = number.size(); i-- > 1;)
    std::swap(number[i], number[static_cast<std::size_t>(random.between(0.0, static_cast<double>(i)))]);
  TwoBodies result{.matrix = {}, .body_of_row = std::vector<Index>(number.size())};
  BlockTriplets& a = result.matrix;
  a.diagonal.assign(number.size(), 1e-9 * Tensor::Identity());
  const auto row = [&](Index body, Index x, Index y) { return number[(body * edge + x) * edge + y]; };
  const auto couple = [&](Index i, Index j, double stiffness) {
    const Tensor c = stiffness * random.between(0.2, 1.0) * Tensor::Identity();
    a.diagonal[i] += c;
    a.diagonal[j] += c;
    a.off_diagonal.push_back({i, j, -c});
  };
  for (Index x = 0; x < edge; ++x)
    for (Index y = 0; y < edge; ++y) {
      for (const Index body : {0, 1}) {
        result.body_of_row[row(body, x, y)] = body;
        if (x > 0) couple(row(body, x, y), row(body, x - 1, y), 1.0);
        if (y > 0) couple(row(body, x, y), row(body, x, y - 1), 1.0);
      }
      couple(row(0, x, y), row(1, x, y), 1e-6);
    }
  return result;
}

// One aggregate with rows of both bodies would be enough to leave the motion of one against the other to the smoother.
TEST_F(Multigrids, NoAggregateReachesAcrossABrokenLayer) {
  RandomNumbers random;
  for (int trial = 0; trial < 20; ++trial) {
    TwoBodies bodies = two_bodies(40, random);
    BlockMatrix matrix = compress(bodies.matrix, in_order(bodies.body_of_row.size()));
    for (int level = 0; level < 3; ++level) {
      const Aggregates aggregates = aggregate(matrix, 3);
      EXPECT_LE(aggregates.count, matrix.n_rows() / 4);
      std::vector<Index> body_of_aggregate(aggregates.count, -1);
      for (std::size_t i = 0; i < aggregates.of_row.size(); ++i) {
        ASSERT_GE(aggregates.of_row[i], 0);
        Index& body = body_of_aggregate[aggregates.of_row[i]];
        if (body < 0) body = bodies.body_of_row[i];
        EXPECT_EQ(body, bodies.body_of_row[i]) << "numbering " << trial << ", level " << level;
      }
      matrix = coarsen(matrix, aggregates);
      bodies.body_of_row = std::move(body_of_aggregate);
    }
  }
}

}  // namespace
}  // namespace pfdm::this_file
