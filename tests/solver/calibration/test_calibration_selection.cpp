// Least squares that choose their coefficients: the number of them, and those that are not negative.

#include "solver/calibration/calibration.h"
#include "solver/parallel.h"
#include "tests/solver/simple_fits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pfdm::this_file {
namespace {

TEST(Calibration, BayesianInformationFindsTheDegree) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal(0.0, 0.01);
  const std::vector<double> x = abscissas(100);
  Eigen::VectorXd y(100);
  for (Eigen::Index i = 0; i < 100; ++i) {
    const double xi = x[i];
    y[i] = 1.0 - xi + 0.5 * xi * xi + normal(engine);
  }
  std::vector<double> information;
  for (Eigen::Index n = 1; n <= 6; ++n) {
    Eigen::MatrixXd A(100, n);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < 100; ++i) A(i, j) = std::pow(x[i], double(j));
    const double sum = (A * A.colPivHouseholderQr().solve(y) - y).squaredNorm();
    information.push_back(bayesian_information(sum, 100, static_cast<std::size_t>(n), 0.0));
  }
  EXPECT_EQ(std::ranges::min_element(information) - information.begin(), 2);
}

TEST(Calibration, NonNegativeLeastSquares) {
  // Against all subsets of columns.
  std::mt19937 engine(6);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(12, 5, [&] { return normal(engine); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(12, [&] { return normal(engine); });
    double least = b.squaredNorm();
    for (int subset = 1; subset < 32; ++subset) {
      std::vector<Eigen::Index> columns;
      for (Eigen::Index j = 0; j < 5; ++j)
        if ((subset >> j & 1) != 0) columns.push_back(j);
      const Eigen::MatrixXd part = A(Eigen::all, columns);
      const Eigen::VectorXd x = part.colPivHouseholderQr().solve(b);
      if (x.minCoeff() >= 0.0) least = std::min(least, (part * x - b).squaredNorm());
    }
    const Eigen::VectorXd x = non_negative_least_squares(A, b);
    EXPECT_GE(x.minCoeff(), 0.0);
    EXPECT_NEAR((A * x - b).squaredNorm(), least, 1e-10);
  }
}

}  // namespace
}  // namespace pfdm::this_file
