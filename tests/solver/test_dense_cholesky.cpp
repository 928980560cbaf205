// Dense Cholesky factors and scalar products in one order of operations.

#include "solver/linear/dense_cholesky.h"
#include "solver/linear/ordered_sums.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <vector>

namespace pfdm {
namespace {

// Diagonally dominant, n x n.
Eigen::MatrixXf sample(Index n) {
  Eigen::MatrixXf a(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      a(i, j) = i == j ? 2.0F * static_cast<float>(n) : std::sin(1.0F + float(i) * float(j));
  return a;
}

std::vector<float> columns_of(const Eigen::MatrixXf& a) { return {a.data(), a.data() + a.size()}; }

TEST(DenseCholesky, SolvesAsEigenDoes) {
  for (const Index n : {1, 7, 8, 9, 16, 61}) {
    const Eigen::MatrixXf a = sample(n);
    std::vector<float> b(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) b[static_cast<std::size_t>(i)] = std::cos(float(i));
    const Eigen::VectorXf right = a.llt().solve(Eigen::Map<Eigen::VectorXf>(b.data(), n));
    DenseCholesky factors;
    ASSERT_TRUE(factors.compute(n, columns_of(a)));
    factors.solve(b);
    EXPECT_LE((Eigen::Map<Eigen::VectorXf>(b.data(), n) - right).norm(), 1e-5F * right.norm()) << n;
  }
}

TEST(DenseCholesky, RefusesWhatIsNotPositiveDefinite) {
  DenseCholesky factors;
  Eigen::MatrixXf a = sample(20);
  a(17, 17) = -1.0F;
  EXPECT_FALSE(factors.compute(20, columns_of(a)));
  a(17, 17) = std::nanf("");
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
}  // namespace pfdm
