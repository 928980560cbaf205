#include "solver/vibration/identification_least_squares.h"

#include "solver/linear/dense_algebra.h"

#include <unsupported/Eigen/NonLinearOptimization>

#include <cmath>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// In the terms that Eigen's solver wants.
struct Functor {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const LeastSquaresProblem& problem;
  mutable double worst = 1.0;  // of the residuals seen, for parameters where there are none

  int inputs() const { return static_cast<int>(problem.n_parameters); }
  int values() const { return static_cast<int>(problem.n_residuals); }
  int operator()(const VectorXd& x, VectorXd& f) const {
    problem.residuals(x, f);
    if (!f.allFinite())
      f.setConstant(1e3 * worst);
    else
      worst = std::max(worst, f.lpNorm<Eigen::Infinity>());
    return 0;
  }
  int df(const VectorXd& x, MatrixXd& jacobian) const {
    problem.jacobian(x, jacobian);
    // A neighbour with unbounded motion gives no information on this parameter.
    for (Eigen::Index k = 0; k < jacobian.cols(); ++k)
      if (!jacobian.col(k).allFinite()) jacobian.col(k).setZero();
    return 0;
  }
};

}  // namespace

LeastSquaresResult minimise(const LeastSquaresProblem& problem, const VectorXd& start, double tolerance,
                            int maximum_iterations) {
  LeastSquaresResult result{.parameters = start, .path = {}};
  VectorXd first(problem.n_residuals);
  problem.residuals(start, first);
  if (!first.allFinite()) return result;
  Functor functor{problem};
  Eigen::LevenbergMarquardt<Functor> solver(functor);
  solver.parameters.ftol = tolerance;
  solver.parameters.xtol = tolerance;
  solver.parameters.gtol = 0.0;
  solver.parameters.maxfev = 20 * maximum_iterations;
  auto status = solver.minimizeInit(result.parameters);
  for (int i = 0; i < maximum_iterations; ++i) {
    status = solver.minimizeOneStep(result.parameters);
    result.path.push_back(solver.fnorm);
    if (status != Eigen::LevenbergMarquardtSpace::Running) break;
  }
  using namespace Eigen::LevenbergMarquardtSpace;
  result.converged = status != Running && status != TooManyFunctionEvaluation && status != ImproperInputParameters;
  return result;
}

VectorXd solve_scaled(const MatrixXd& A, const VectorXd& q) {
  const VectorXd norms = A.colwise().norm().cwiseMax(1e-300);
  const VectorXd scaled = least_squares(A * norms.cwiseInverse().asDiagonal(), q);
  return scaled.cwiseQuotient(norms);  // A/s (s p) = q: to get p, divide; the report (A4.3, step 4) says multiply
}

}  // namespace pfdm
