#pragma once
// Cubic polynomials in space by weighted least squares, for the faces of cubic_faces.h; and through values on a line,
// for the lines of layer_gradients.h.

#include "physics/tensor.h"

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace pfdm {
namespace cubic {

constexpr int n_monomials = 19;
/// Powers of the coordinates, in the order in which they are fitted: what samples do not tell from those before is left
/// out.
constexpr std::array<std::array<int, 3>, n_monomials> powers{{{1, 0, 0},
                                                              {0, 1, 0},
                                                              {0, 0, 1},
                                                              {2, 0, 0},
                                                              {0, 2, 0},
                                                              {0, 0, 2},
                                                              {1, 1, 0},
                                                              {1, 0, 1},
                                                              {0, 1, 1},
                                                              {3, 0, 0},
                                                              {0, 3, 0},
                                                              {0, 0, 3},
                                                              {2, 1, 0},
                                                              {2, 0, 1},
                                                              {1, 2, 0},
                                                              {0, 2, 1},
                                                              {1, 0, 2},
                                                              {0, 1, 2},
                                                              {1, 1, 1}}};
using Row = Eigen::Matrix<double, 1, n_monomials>;
using Wanted = std::array<bool, n_monomials>;

int degree(int monomial);
/// Values at x.
Row monomials(const Vector& x);
/// Derivatives at x by the coordinate number a.
Row derivative(const Vector& x, int a);

/// Weights of values at the first `n` of these places in the mean over [-1/2, 1/2] of the polynomial through them.
std::array<double, 4> mean_weights(const std::array<double, 4>& places, std::size_t n);

}  // namespace cubic

/// A polynomial of least squares: its coefficients are linear in u_j - u_c, j being the samples.
class CubicFit {
 public:
  /// Fit to samples at these places, in units of the cell's edges, in the monomials that are wanted; weight |x|^-3 of
  /// each difference.
  CubicFit(const std::vector<Vector>& places, const cubic::Wanted& wanted);

  /// Whether the samples tell all linear fields.
  bool is_sound() const { return is_sound_; }
  /// Coefficients of the samples in a linear functional of the polynomial's coefficients.
  Eigen::RowVectorXd operator()(const cubic::Row& functional) const { return functional * solution_; }

 private:
  void orthogonalise(const Eigen::MatrixXd& A, const cubic::Wanted& wanted);

  Eigen::MatrixXd solution_, Q_, R_;
  std::vector<int> kept_;
  Eigen::Index n_ = 0;
  bool is_sound_ = true;
};

}  // namespace pfdm
