// Aggregation, multigrid and flexible GMRES on symmetric matrices of 3x3 blocks, to the true residual.

#include "solver/linear/multigrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "solver/linear/fgmres.h"
#include "solver/momentum/momentum.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

Tensor random_positive(RandomNumbers& random) {
  const Tensor a = random.tensor();
  return a * a.transpose() + 0.1 * Tensor::Identity();
}

// Rows that are coupled by random blocks to a few others, and held a little: the matrix of a random truss.
BlockTriplets random_problem(Index n) {
  RandomNumbers random;
  BlockTriplets a;
  a.diagonal.resize(n);
  for (Tensor& block : a.diagonal) block = 0.01 * random_positive(random);
  for (Index i = 1; i < n; ++i)
    for (const Index j : std::set<Index>{i - 1, i / 2, i / 3}) {
      const Tensor c = random_positive(random);
      a.diagonal[i] += c;
      a.diagonal[j] += c;
      a.off_diagonal.push_back({i, j, -c});
    }
  return a;
}

// The compact matrix of a clamped block of rubber with cells of random stiffness.
BlockTriplets elastic_problem(Index cells_along_an_edge) {
  const Mesh mesh = box(cells_along_an_edge, cells_along_an_edge, cells_along_an_edge);
  FractureModel model;
  model.regions.push_back({.elasticity = from_young_poisson(75e6, 0.44)});
  model.boundary = {clamped("zmin")};
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumOperator balance(mesh, unknowns);
  RandomNumbers random;
  CellField<double> g(mesh.n_cells());
  CellField<IsotropicElasticity> moduli(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    g[c] = std::pow(10.0, random.between(-3.0, 0.0));
    const IsotropicElasticity& whole = model.regions.front().elasticity;
    moduli[c] = {.lambda = g[c] * whole.lambda, .mu = g[c] * whole.mu};
  }
  balance.set_moduli(moduli, g);
  return balance.compact_matrix();
}

void multiply(const BlockTriplets& a, const std::vector<Vector>& x, std::vector<Vector>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = a.diagonal[i] * x[i];
  for (const auto& [row, column, value] : a.off_diagonal) {
    y[row] += value * x[column];
    y[column] += value.transpose() * x[row];
  }
}

std::vector<Index> in_order(std::size_t n) {
  std::vector<Index> position(n);
  std::iota(position.begin(), position.end(), 0);
  return position;
}

KrylovProblem problem_of(const BlockTriplets& a, Multigrid& multigrid) {
  const auto to_lanes = [](const std::vector<Vector>& v) {
    std::vector<Lane> lanes(v.size(), Lane::Zero());
    for (std::size_t i = 0; i < v.size(); ++i) lanes[i].head<3>() = v[i].cast<float>();
    return lanes;
  };
  std::vector<double> scale;
  for (const Tensor& block : a.diagonal) scale.push_back(1.0 / std::sqrt(block.trace() / 3.0));
  return {.apply = [&a](const auto& x, auto& y) { multiply(a, x, y); },
          .precondition =
              [&multigrid, to_lanes](const auto& r, auto& z) {
                std::vector<Lane> x(r.size(), Lane::Zero());
                multigrid.apply(to_lanes(r), x);
                for (std::size_t i = 0; i < z.size(); ++i) z[i] = x[i].template head<3>().template cast<double>();
              },
          .scale = scale};
}

double residual(const BlockTriplets& a, const std::vector<Vector>& x, const std::vector<Vector>& b,
                const std::vector<double>& scale) {
  std::vector<Vector> r(x.size());
  multiply(a, x, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  return scaled_norm(r, scale);
}

std::vector<Vector> random_vectors(std::size_t n) {
  RandomNumbers random;
  std::vector<Vector> b(n);
  for (Vector& v : b) v = random.vector();
  return b;
}

// Solves from zero and returns the iterations it took.
Index expect_solved(const BlockTriplets& a, double tolerance) {
  Multigrid multigrid(compress(a, in_order(a.diagonal.size())));
  const KrylovProblem problem = problem_of(a, multigrid);
  const std::vector<Vector> b = random_vectors(a.diagonal.size());
  std::vector<Vector> x(b.size(), Vector::Zero());
  const KrylovResult result = solve_fgmres(
      problem, b, x, [&](double initial) { return tolerance * initial; }, 200);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.initial_residual, scaled_norm(b, problem.scale), 1e-12 * result.initial_residual);
  const double truth = residual(a, x, b, problem.scale);
  EXPECT_LE(truth, tolerance * result.initial_residual);
  EXPECT_NEAR(result.residual, truth, 0.02 * truth) << "what is reported is not true";
  return result.iterations;
}

using Multigrids = WithThreads;

TEST_F(Multigrids, SmallMatricesAreSolvedDirectly) {
  const BlockTriplets a = random_problem(100);
  EXPECT_EQ(Multigrid(compress(a, in_order(100))).n_levels(), 1);
  EXPECT_LE(expect_solved(a, 1e-12), 4);
}

TEST_F(Multigrids, RandomPositiveMatrix) {
  EXPECT_GT(Multigrid(compress(random_problem(1500), in_order(1500))).n_levels(), 1);
  EXPECT_LE(expect_solved(random_problem(1500), 1e-10), 60);
}

TEST_F(Multigrids, BlockOfRandomStiffness) {
  const Index few = expect_solved(elastic_problem(8), 1e-10), many = expect_solved(elastic_problem(16), 1e-10);
  EXPECT_LE(few, 70);
  EXPECT_LE(many, 1.5 * few) << "eight times the cells";
}

TEST_F(Multigrids, OrderOfTheRowsChangesOnlyTheWay) {
  const BlockTriplets a = random_problem(400);
  std::vector<Index> backwards = in_order(400);
  std::reverse(backwards.begin(), backwards.end());
  const BlockMatrix matrix = compress(a, backwards);
  for (Index i = 0; i < 400; ++i) EXPECT_TRUE(to_tensor(matrix.diagonal[399 - i]).isApprox(a.diagonal[i], 1e-6));
}

TEST_F(Multigrids, AnswersAreBitwiseTheSameForAnyNumberOfThreads) {
  const BlockTriplets a = elastic_problem(16);
  const std::vector<Vector> b = random_vectors(a.diagonal.size());
  std::vector<std::vector<Vector>> answers;
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    Multigrid multigrid(compress(a, in_order(b.size())));
    answers.emplace_back(b.size(), Vector::Zero());
    solve_fgmres(
        problem_of(a, multigrid), b, answers.back(), [](double initial) { return 1e-8 * initial; }, 200);
  }
  EXPECT_EQ(answers[1], answers[0]);
  EXPECT_EQ(answers[2], answers[0]);
}

// A cyclic shift of rows: no residual falls before as many iterations as there are rows.
TEST_F(Multigrids, StagnationEndsWhatIsGoodEnough) {
  constexpr Index n = 500, cycle = 20, most = 200;
  const auto shift = [&](const std::vector<Vector>& x, std::vector<Vector>& y) {
    for (Index i = 0; i < n; ++i) y[(i + 1) % n] = x[i];
  };
  KrylovProblem problem{.apply = shift,
                        .precondition = [](const std::vector<Vector>& r, std::vector<Vector>& z) { z = r; },
                        .scale = std::vector<double>(n, 1.0),
                        .restart_length = cycle};
  const auto solve = [&](double good_enough) {
    problem.good_enough = good_enough;
    std::vector<Vector> b(n, Vector::Zero()), x = b;
    b.front() = Vector::UnitX();
    return solve_fgmres(
        problem, b, x, [](double initial) { return 1e-6 * initial; }, most);
  };
  const KrylovResult stopped = solve(1.0), not_yet = solve(0.9);
  EXPECT_EQ(stopped.iterations, cycle);
  EXPECT_FALSE(stopped.converged);
  EXPECT_DOUBLE_EQ(stopped.residual, 1.0);
  EXPECT_EQ(not_yet.iterations, most);
}

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

TEST_F(Multigrids, NothingToDoTakesNoIteration) {
  const BlockTriplets a = random_problem(50);
  Multigrid multigrid(compress(a, in_order(50)));
  std::vector<Vector> x = random_vectors(50), b(50);
  multiply(a, x, b);
  const auto before = x;
  const KrylovResult result = solve_fgmres(
      problem_of(a, multigrid), b, x, [](double) { return 1e-9; }, 10);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(x, before);
}

TEST_F(Multigrids, TooFewIterationsAreNotCalledConverged) {
  const BlockTriplets a = random_problem(1500);
  Multigrid multigrid(compress(a, in_order(1500)));
  const std::vector<Vector> b = random_vectors(1500);
  std::vector<Vector> x(1500, Vector::Zero());
  const KrylovProblem problem = problem_of(a, multigrid);
  const KrylovResult result = solve_fgmres(
      problem, b, x, [](double initial) { return 1e-12 * initial; }, 2);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_NEAR(result.residual, residual(a, x, b, problem.scale), 0.02 * result.residual);
}

}  // namespace
}  // namespace pfdm::this_file
