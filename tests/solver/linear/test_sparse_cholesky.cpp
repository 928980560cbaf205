// Sparse Cholesky factors, against Eigen's dense ones.

#include "solver/linear/sparse_cholesky.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>
#include <thread>

#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

// Rows in a chain with random couplings to a few others, each held by `held`.
BlockTriplets random_matrix(Index n, double held) {
  RandomNumbers random;
  BlockTriplets a;
  a.diagonal.assign(n, held * Tensor::Identity());
  const auto couple = [&](Index i, Index j) {
    const Tensor root = random.tensor(), c = root * root.transpose() + 0.1 * Tensor::Identity();
    a.diagonal[i] += c;
    a.diagonal[j] += c;
    a.off_diagonal.push_back({i, j, -c});
  };
  for (Index i = 1; i < n; ++i) {
    couple(i, i - 1);
    if (i > 7) couple(i / 3, i);
  }
  return a;
}

Eigen::MatrixXd dense(const BlockTriplets& a) {
  const auto n = 3 * count_of(a.diagonal);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < a.diagonal.size(); ++i) m.block<3, 3>(3 * Index(i), 3 * Index(i)) = a.diagonal[i];
  for (const auto& [row, column, value] : a.off_diagonal) {
    m.block<3, 3>(3 * row, 3 * column) += value;
    m.block<3, 3>(3 * column, 3 * row) += value.transpose();
  }
  return m;
}

std::vector<Vector> random_vectors(Index n) {
  RandomNumbers random;
  std::vector<Vector> b(n);
  for (Vector& v : b) v = random.vector();
  return b;
}

Eigen::VectorXd flat(const std::vector<Vector>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v[0].data(), 3 * count_of(v));
}

std::vector<Vector> solution(SparseCholesky& cholesky, const std::vector<Vector>& b) {
  std::vector<Vector> x(b.size(), Vector::Zero());
  cholesky.solve(b, x);
  return x;
}

TEST(SparseCholesky, SolvesAsDenseFactorsDo) {
  for (const Index n : {1, 2, 60}) {
    const BlockTriplets a = random_matrix(n, 0.1);
    const std::vector<Vector> b = random_vectors(n);
    SparseCholesky cholesky;
    ASSERT_FALSE(cholesky.factor(a).has_value());
    const Eigen::VectorXd exact = dense(a).ldlt().solve(flat(b));
    EXPECT_LE((flat(solution(cholesky, b)) - exact).norm(), 1e-12 * exact.norm());
  }
}

TEST(SparseCholesky, VectorsBeyondTheRowsStay) {
  SparseCholesky cholesky;
  ASSERT_FALSE(cholesky.factor(random_matrix(5, 0.1)).has_value());
  std::vector<Vector> b = random_vectors(7), x(7, Vector::Constant(3.0));
  cholesky.solve(b, x);
  EXPECT_NE(x[4], Vector::Constant(3.0));
  EXPECT_EQ(x[5], Vector::Constant(3.0));
}

TEST(SparseCholesky, OrdersAgainOnlyIfThePatternHasChanged) {
  BlockTriplets a = random_matrix(60, 0.1);
  const std::vector<Vector> b = random_vectors(60);
  SparseCholesky cholesky;
  cholesky.factor(a);
  for (Tensor& block : a.diagonal) block *= 1.5;
  cholesky.factor(a);
  EXPECT_EQ(cholesky.n_orderings(), 1);
  const Eigen::VectorXd exact = dense(a).ldlt().solve(flat(b));
  EXPECT_LE((flat(solution(cholesky, b)) - exact).norm(), 1e-12 * exact.norm());
  a.off_diagonal[3].value.setZero();
  ASSERT_FALSE(cholesky.factor(a).has_value());
  EXPECT_EQ(cholesky.n_orderings(), 2);
  const Eigen::VectorXd without = dense(a).ldlt().solve(flat(b));
  EXPECT_LE((flat(solution(cholesky, b)) - without).norm(), 1e-12 * without.norm());
}

// Nothing holds the chain: forces that balance have a solution all the same.
TEST(SparseCholesky, SingularMatrixIsShifted) {
  const BlockTriplets a = random_matrix(60, 0.0);
  const std::vector<Vector> free = random_vectors(60);
  const Eigen::VectorXd balanced = dense(a) * flat(free);
  std::vector<Vector> b(60);
  for (Index i = 0; i < 60; ++i) b[i] = balanced.segment<3>(3 * i);
  SparseCholesky cholesky;
  ASSERT_FALSE(cholesky.factor(a).has_value());
  const Eigen::VectorXd x = flat(solution(cholesky, b));
  EXPECT_LE((dense(a) * x - balanced).norm(), 1e-5 * balanced.norm());
}

TEST(SparseCholesky, NamesTheRowThatCannotBeFactored) {
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BlockTriplets a = random_matrix(60, 0.1);
    a.diagonal[17](1, 1) = bad;
    SparseCholesky cholesky;
    EXPECT_EQ(cholesky.factor(a), 17) << bad;
  }
  BlockTriplets indefinite = random_matrix(2, 0.1);
  indefinite.off_diagonal[0].value *= 10.0;
  SparseCholesky cholesky;
  EXPECT_TRUE(cholesky.factor(indefinite).has_value());
  EXPECT_FALSE(cholesky.factor(random_matrix(2, 0.1)).has_value()) << "of use again";
}

TEST(SparseCholesky, IsTheSameFromManyThreadsAtOnce) {
  const BlockTriplets a = random_matrix(400, 0.1);
  const std::vector<Vector> b = random_vectors(400);
  std::vector<std::vector<Vector>> answers(4);
  std::vector<std::thread> threads;
  threads.reserve(answers.size());
  for (auto& answer : answers)
    threads.emplace_back([&a, &b, &answer] {
      SparseCholesky cholesky;
      cholesky.factor(a);
      answer = solution(cholesky, b);
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
}

}  // namespace
}  // namespace pfdm::this_file
