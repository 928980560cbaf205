#include "solver/vibration/signals/impulse_response.h"

#include "physics/error.h"
#include "solver/calibration/calibration.h"
#include "solver/linear/dense_algebra.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>

namespace pfdm {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_singular_value = 1e-10;  // of the largest: rounding
constexpr double allowed_factor = 20.0;         // by which least squares may move a pole's parts

// Columns exp(-alpha t), of a pair 2 Re and -2 Im of it, which the real and imaginary part of beta multiply.
MatrixXd basis_of(const std::vector<Complex>& alphas, Eigen::Index n, double rate) {
  Eigen::Index columns = 0;
  for (const Complex alpha : alphas) columns += alpha.imag() != 0.0 ? 2 : 1;
  MatrixXd basis(n, columns);
  Eigen::Index column = 0;
  for (const Complex alpha : alphas) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const Complex decay = std::exp(-alpha * (static_cast<double>(k) / rate));
      basis(k, column) = alpha.imag() != 0.0 ? 2.0 * decay.real() : decay.real();
      if (alpha.imag() != 0.0) basis(k, column + 1) = -2.0 * decay.imag();
    }
    column += alpha.imag() != 0.0 ? 2 : 1;
  }
  return basis;
}

ImpulseFit with_weights(const VectorXd& g, double rate, const std::vector<Complex>& alphas, int order) {
  ImpulseFit fit{.terms = {}, .order = order, .misfit = 1.0};
  if (alphas.empty()) return fit;
  const MatrixXd basis = basis_of(alphas, g.size(), rate);
  const VectorXd weights = scaled_least_squares(basis, g);
  Eigen::Index column = 0;
  for (const Complex alpha : alphas) {
    const bool pair = alpha.imag() != 0.0;
    fit.terms.push_back({alpha, {weights[column], pair ? weights[column + 1] : 0.0}});
    column += pair ? 2 : 1;
  }
  fit.misfit = (g - basis * weights).norm() / g.norm();
  return fit;
}

int number_that_stand_out(const VectorXd& singular_values, double rows_over_columns) {
  const double b = rows_over_columns;
  const double median = singular_values[singular_values.size() / 2];
  const double threshold =
      std::max((0.56 * b * b * b - 0.95 * b * b + 1.82 * b + 1.43) * median, least_singular_value * singular_values[0]);
  return static_cast<int>((singular_values.array() > threshold).count());
}

// From real parts, and imaginary parts of pairs, in the order of `like`.
std::vector<Complex> alphas_of(std::span<const double> parts, const std::vector<Complex>& like) {
  std::vector<Complex> alphas;
  std::size_t i = 0;
  for (const Complex alpha : like) {
    const double decay = parts[i++];
    alphas.emplace_back(decay, alpha.imag() != 0.0 ? parts[i++] : 0.0);
  }
  return alphas;
}

ImpulseFit refined(const VectorXd& g, double rate, const ImpulseFit& start) {
  std::vector<Complex> alphas;
  for (const HereditaryTerm& term : start.terms) alphas.push_back(term.alpha);
  if (alphas.empty()) return start;
  FitProblem problem;
  const auto vary = [&](double part) {
    problem.parameters.push_back({.name = fmt::format("part {}", problem.parameters.size() + 1),
                                  .unit = "1/s",
                                  .first = part,
                                  .lower = part / allowed_factor,
                                  .upper = part * allowed_factor,
                                  .log_scale = true});
  };
  for (const Complex alpha : alphas) {
    vary(alpha.real());
    if (alpha.imag() != 0.0) vary(alpha.imag());
  }
  problem.residuals = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
    const MatrixXd basis = basis_of(alphas_of(p, alphas), g.size(), rate);
    const VectorXd residual = g - basis * scaled_least_squares(basis, g);
    return std::vector<double>(residual.begin(), residual.end());
  };
  const std::vector<double> found = fit(problem, {.maximum_iterations = 100, .side_by_side = false}).values();
  const ImpulseFit moved = with_weights(g, rate, alphas_of(found, alphas), start.order);
  return moved.misfit < start.misfit ? moved : start;
}

double information(const ImpulseFit& fit, const VectorXd& g) {
  const double squares = fit.misfit * fit.misfit * g.squaredNorm();
  constexpr double rounding = 1e-12;
  return bayesian_information(squares, static_cast<std::size_t>(g.size()), 2 * static_cast<std::size_t>(fit.order),
                              rounding * g.norm() / std::sqrt(static_cast<double>(g.size())));
}

// The samples' Hankel matrix, whose right singular vectors are shifted by the poles.
class Pencil {
 public:
  Pencil(const VectorXd& g, double rate, int order) : g_(g), rate_(rate) {
    const Eigen::Index n = g.size(), length = n / 3;
    if (n < std::max(12, 3 * order))
      throw InputError(fmt::format("an impulse response of {} samples is too short; at least {} are required", n,
                                   std::max(12, 3 * order)));
    if (!g.allFinite() || !(g.norm() > 0.0))
      throw InputError("an impulse response needs finite samples that are not all zero");
    MatrixXd hankel(n - length, length + 1);
    for (Eigen::Index j = 0; j <= length; ++j) hankel.col(j) = g.segment(j, n - length);
    svd_.compute(hankel, Eigen::ComputeThinU | Eigen::ComputeThinV);
  }

  int order() const {
    const auto columns = static_cast<double>(svd_.matrixV().rows());
    return number_that_stand_out(svd_.singularValues(), columns / static_cast<double>(svd_.matrixU().rows()));
  }

  ImpulseFit fit(int order) const {
    if (order == 0) return with_weights(g_, rate_, {}, 0);  // nothing but noise
    const MatrixXd V = svd_.matrixV().leftCols(order);
    const Eigen::Index length = V.rows() - 1;
    const MatrixXd shift = V.topRows(length).colPivHouseholderQr().solve(V.bottomRows(length));
    std::vector<Complex> alphas;
    for (const Complex z : eigenvalues(shift)) {
      const bool real = z.imag() == 0.0;
      if (!(std::abs(z) < 1.0) || z.imag() < 0.0 || (real && z.real() <= 0.0)) continue;
      // Either one of a pair will do.
      alphas.emplace_back(-rate_ * std::log(std::abs(z)), real ? 0.0 : rate_ * std::arg(z));
    }
    std::ranges::sort(alphas, {}, [](const Complex& alpha) { return alpha.real(); });
    return with_weights(g_, rate_, alphas, order);
  }

 private:
  const VectorXd& g_;
  double rate_;
  Eigen::BDCSVD<MatrixXd> svd_;
};

}  // namespace

ImpulseFit matrix_pencil(const VectorXd& g, double rate, int order) {
  const Pencil pencil(g, rate, order);
  return pencil.fit(order > 0 ? order : pencil.order());
}

ImpulseFit fit_impulse_response(const VectorXd& g, double rate, int order) {
  const Pencil pencil(g, rate, order);
  if (order > 0) return refined(g, rate, pencil.fit(order));
  ImpulseFit best = refined(g, rate, pencil.fit(pencil.order()));
  // The noise of a Hankel matrix repeats along its diagonals: more singular values stand out than there are poles.
  for (int fewer = best.order - 1; fewer > 0; --fewer) {
    const ImpulseFit candidate = refined(g, rate, pencil.fit(fewer));
    if (information(candidate, g) < information(best, g)) best = candidate;
  }
  return best;
}

}  // namespace pfdm
