// Multigrid and flexible GMRES on symmetric matrices of 3x3 blocks, to the true residual.

#include "solver/linear/fgmres.h"
#include "solver/linear/multigrid.h"
#include "solver/momentum/momentum.h"
#include "tests/solver/block_problems.h"
#include "tests/solver/solver_checks.h"

#include <algorithm>
#include <vector>

namespace pfdm::this_file {
namespace {

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
