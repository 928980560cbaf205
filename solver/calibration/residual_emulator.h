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

  /// Sum of squares of the residuals, each over 1 + its own error over the noise.
  double sum_of_squares(const Eigen::VectorXd& z) const;
  /// Sums of squares of the points, of plain residuals, and each by the polynomials through the others.
  const Eigen::VectorXd& given() const { return given_; }
  const Eigen::VectorXd& left_out() const { return left_out_; }

 private:
  Eigen::Index n_monomials(int degree) const;

  Eigen::Index n_coordinates_;
  int degree_ = 2;
  std::vector<Eigen::VectorXd> points_, residuals_;
  Eigen::MatrixXd squares_;
  Eigen::VectorXd given_, left_out_;
};

}  // namespace pfdm
