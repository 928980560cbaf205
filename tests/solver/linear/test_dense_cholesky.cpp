// Dense Cholesky factors and scalar products in one order of operations.

#include "solver/linear/dense_cholesky.h"
#include "solver/linear/ordered_sums.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <vector>

namespace pfdm::this_file {
namespace {

// Diagonally dominant, n x n.
Eigen::MatrixXd sample(Index n) {
  Eigen::MatrixXd a(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      a(i, j) = i == j ? 2.0 * static_cast<double>(n) : std::sin(1.0 + double(i) * double(j));
  return a;
}

std::vector<double> columns_of(const Eigen::MatrixXd& a) { return {a.data(), a.data() + a.size()}; }

TEST(DenseCholesky, SolvesAsEigenDoes) {
  for (const Index n : {1, 7, 8, 9, 16, 61}) {
    const Eigen::MatrixXd a = sample(n);
    std::vector<double> b(n);
    for (Index i = 0; i < n; ++i) b[i] = std::cos(double(i));
    const Eigen::VectorXd right = a.llt().solve(Eigen::Map<Eigen::VectorXd>(b.data(), n));
    DenseCholesky factors;
    ASSERT_TRUE(factors.compute(n, columns_of(a)));
    factors.solve(b);
    EXPECT_LE((Eigen::Map<Eigen::VectorXd>(b.data(), n) - right).norm(), 1e-12 * right.norm()) << n;
  }
}

TEST(DenseCholesky, RefusesWhatIsNotPositiveDefinite) {
  DenseCholesky factors;
  Eigen::MatrixXd a = sample(20);
  a(17, 17) = -1.0;
  EXPECT_FALSE(factors.compute(20, columns_of(a)));
  a(17, 17) = std::nan("");
  EXPECT_FALSE(factors.compute(20, columns_of(a)));
}

TEST(OrderedDot, AddsAllProducts) {
  std::vector<double> a, b;
  for (int i = 0; i < 53; ++i) {
    a.push_back(i);
    b.push_back(2 * i + 1);
  }
  for (const Index n : {0, 1, 15, 16, 17, 53}) {
    double sum = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) sum += a[i] * b[i];
    EXPECT_EQ(ordered_dot(a.data(), b.data(), n), sum) << n;
  }
}

}  // namespace
}  // namespace pfdm::this_file
