// Minima of sums of squares that are known in closed form.

#include "solver/calibration/levenberg_marquardt.h"
#include "solver/linear/dense_algebra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

LeastSquaresProblem rosenbrock() {
  return {.residuals = [](const VectorXd& x) -> std::optional<VectorXd> {
            return Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]);
          },
          .jacobian = [](const VectorXd& x) -> std::optional<MatrixXd> {
            MatrixXd J(2, 2);
            J << -20.0 * x[0], 10.0, -1.0, 0.0;
            return J;
          }};
}

TEST(LevenbergMarquardt, FindsAMinimumAndTellsItsPath) {
  int told = 0;
  const LeastSquaresResult found =
      minimise(rosenbrock(), Vector2d(-1.2, 1.0), {.iterated = [&](const LeastSquaresPoint&) { ++told; }});
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_LT((found.x - Vector2d(1.0, 1.0)).norm(), 1e-8);
  ASSERT_GT(found.path.size(), 2U);
  EXPECT_EQ(found.path.front().x, Vector2d(-1.2, 1.0));
  EXPECT_DOUBLE_EQ(found.path.front().cost, 0.5 * (4.4 * 4.4 + 2.2 * 2.2));
  EXPECT_EQ(found.path.back().x, found.x);
  EXPECT_EQ(std::ssize(found.path), told);
}

TEST(LevenbergMarquardt, TakesDifferencesAndAsksForNoResidualTwice) {
  LeastSquaresProblem problem = rosenbrock();
  problem.jacobian = {};
  EXPECT_LT((minimise(problem, Vector2d(-1.2, 1.0)).x - Vector2d(1.0, 1.0)).norm(), 1e-8);
  std::vector<VectorXd> asked;
  problem = rosenbrock();
  problem.residuals = [&](const VectorXd& x) {
    asked.push_back(x);
    return rosenbrock().residuals(x);
  };
  minimise(problem, Vector2d(-1.2, 1.0));
  for (std::size_t i = 1; i < asked.size(); ++i) EXPECT_NE(asked[i], asked[i - 1]);
}

// Of the line of minima x + y = 3 the bounds leave the point (1, 2); the unbounded minimum of the others is (2, 2).
TEST(LevenbergMarquardt, StaysWithinBounds) {
  LeastSquaresProblem problem{.residuals = [](const VectorXd& x) -> std::optional<VectorXd> {
                                return Vector2d(x[0] + x[1] - 3.0, 0.1 * (x[0] - 2.0));
                              },
                              .bounds = {{-1.0, 1.0}, {-10.0, 10.0}}};
  const LeastSquaresResult found = minimise(problem, Vector2d(0.0, 0.0));
  EXPECT_LT((found.x - Vector2d(1.0, 2.0)).norm(), 1e-6);
  EXPECT_EQ(side_of_bound(found.x[0], problem.bounds[0]), 1);
  EXPECT_EQ(side_of_bound(found.x[1], problem.bounds[1]), 0);
}

// exp(-x) and 1 leave 1/2 at best, which each step comes nearer to by as much in x.
TEST(LevenbergMarquardt, EndsWhereItWouldNotComeDownToWhatIsDue) {
  const LeastSquaresProblem problem{
      .residuals = [](const VectorXd& x) -> std::optional<VectorXd> { return Vector2d(std::exp(-x[0]), 1.0); },
      .jacobian = [](const VectorXd& x) -> std::optional<MatrixXd> { return Vector2d(-std::exp(-x[0]), 0.0); }};
  const auto end_with = [&](double due) {
    return minimise(problem, VectorXd::Zero(1), {.maximum_iterations = 20, .due_cost = due});
  };
  const LeastSquaresResult alone = minimise(problem, VectorXd::Zero(1), {.maximum_iterations = 20});
  EXPECT_LT(end_with(0.4).path.size() + 2, alone.path.size());
  EXPECT_LT(end_with(0.4).cost, 0.502);
  EXPECT_EQ(end_with(0.50001).path.size(), alone.path.size());
}

// ln x has no value for the first step's end.
TEST(LevenbergMarquardt, StepsBackFromWhereThereAreNoResiduals) {
  LeastSquaresProblem problem{.residuals = [](const VectorXd& x) -> std::optional<VectorXd> {
    if (!(x[0] > 0.0)) return std::nullopt;
    return VectorXd::Constant(1, std::log(x[0]));
  }};
  const LeastSquaresResult found = minimise(problem, VectorXd::Constant(1, 10.0));
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_NEAR(found.x[0], 1.0, 1e-8);
  EXPECT_FALSE(minimise(problem, VectorXd::Constant(1, -1.0)).converged);
  EXPECT_TRUE(std::isinf(minimise(problem, VectorXd::Constant(1, -1.0)).cost));
}

TEST(DenseAlgebra, ScalesColumnsByDividing) {
  MatrixXd A = MatrixXd::Random(50, 3);
  A.col(1) *= 1e-7;
  A.col(2) *= 1e9;
  const Eigen::Vector3d p(2.0, 5e6, -3e-7);
  EXPECT_LT(((scaled_least_squares(A, A * p) - p).array() / p.array()).matrix().norm(), 1e-12);
}

}  // namespace
}  // namespace pfdm::this_file
