#pragma once
// Polynomials in place of the residuals of a model that is expensive to run.

#include <Eigen/Core>

#include <vector>

namespace pfdm {

/// Polynomials of the residuals in the coordinates: of second degree, of third where there are enough points.
class ResidualEmulator {
 public:
  explicit ResidualEmulator(Eigen::Index n_coordinates) : n_coordinates_(n_coordinates) {}

  /// Takes the residuals of the model at the coordinates z.
  void add(const Eigen::VectorXd& z, const std::vector<double>& residuals);
  std::size_t n_points() const { return points_.size(); }
  /// Farthest from the estimates, of each coordinate.
  Eigen::VectorXd reach() const;

  /// Fits the polynomials to all points; `variance`: of the noise.
  void fit(double variance);

  /// Products of the coordinates at z; the residuals there are coefficients()^T times these.
  Eigen::VectorXd monomials_at(const Eigen::VectorXd& z) const;
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  /// Variance of each residual over that of the noise: 1, and what the polynomials miss of points that are left out.
  const Eigen::VectorXd& variances() const { return variances_; }
  /// Residuals of the points, one a row, and each by the polynomials through the others.
  const Eigen::MatrixXd& given() const { return given_; }
  const Eigen::MatrixXd& left_out() const { return left_out_; }

 private:
  Eigen::Index n_monomials(int degree) const;

  Eigen::Index n_coordinates_;
  int degree_ = 2;
  std::vector<Eigen::VectorXd> points_, residuals_;
  Eigen::MatrixXd coefficients_, given_, left_out_;
  Eigen::VectorXd variances_;
};

}  // namespace pfdm
