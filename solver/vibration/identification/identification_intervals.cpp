#include "solver/vibration/identification/identification_intervals.h"

#include "solver/calibration/calibration_statistics.h"
#include "solver/linear/dense_algebra.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rest_of_variance = 1e-3;  // at least this part of a score's variance is left by the fit
constexpr double no_information = 1e-7;    // of a column of J, against its norm

/// Blocks in coordinates in which the covariance of the parameters is the noise's variance times the unit matrix.
struct WhiteBlocks {
  MatrixXd back;                  ///< R^-1 of J = Q R: from these coordinates to the parameters
  MatrixXd scores;                ///< a column each, freed of leverage
  std::vector<MatrixXd> normal;   ///< J_k^T J_k
  std::vector<MatrixXd> freeing;  ///< (I - J_k^T J_k)^(-1/2)
};

MatrixXd inverse_root_of_rest(const MatrixXd& normal) {
  const auto [values, V] = singular_values(normal);  // symmetric: its eigenvalues
  const VectorXd rest = (1.0 - values.array()).max(rest_of_variance);
  return V * rest.cwiseSqrt().cwiseInverse().asDiagonal() * V.transpose();
}

WhiteBlocks white_blocks(const VectorXd& r, const MatrixXd& J, std::span<const ResidualBlock> blocks) {
  const Eigen::Index p = J.cols();
  const VectorXd norms = J.colwise().norm().transpose().unaryExpr([](double norm) { return norm > 0.0 ? norm : 1.0; });
  MatrixXd stacked(J.rows() + p, p);
  stacked << J * norms.cwiseInverse().asDiagonal(), no_information * MatrixXd::Identity(p, p);
  const MatrixXd R = upper_triangle(stacked);
  const MatrixXd back = R.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(p, p));
  WhiteBlocks white{norms.cwiseInverse().asDiagonal() * back, MatrixXd(p, std::ssize(blocks)), {}, {}};
  for (const auto& [begin, end] : blocks) {
    const MatrixXd part = stacked.middleRows(begin, end - begin) * back;
    white.normal.emplace_back(part.transpose() * part);
    white.freeing.push_back(inverse_root_of_rest(white.normal.back()));
    white.scores.col(std::ssize(white.normal) - 1) =
        white.freeing.back() * (part.transpose() * r.segment(begin, end - begin));
  }
  return white;
}

/// Of the estimated variance of the parameter of row `a` of `back` under white noise, by Satterthwaite. The scores of
/// two blocks, freed of leverage, have the covariance delta_kl F_k N_k F_k - F_k N_k N_l F_l.
/// None where the fit has taken most of that variance: one block alone knows of the parameter.
double degrees_of_freedom(const WhiteBlocks& white, const VectorXd& a) {
  MatrixXd W(a.size(), white.scores.cols());
  VectorXd own(white.scores.cols());
  for (Eigen::Index k = 0; k < W.cols(); ++k) {
    const VectorXd b = white.freeing[k] * a;
    W.col(k) = white.normal[k] * b;
    own[k] = b.dot(W.col(k));
  }
  const VectorXd taken = W.colwise().squaredNorm();
  const double trace = (own - taken).sum();
  if (!(trace > 0.5 * a.squaredNorm())) return 0.0;
  const double squares = own.squaredNorm() - 2.0 * own.dot(taken) + (W * W.transpose()).squaredNorm();
  return std::max(trace * trace / squares, 1.0);
}

/// Named values of each replicate, a column each.
MatrixXd values_of(const ParameterCoordinates& coordinates, const MatrixXd& replicates) {
  MatrixXd values;
  for (Eigen::Index i = 0; i < replicates.cols(); ++i) {
    const auto named = named_values(coordinates.model(replicates.col(i)));
    if (i == 0) values.resize(std::ssize(named), replicates.cols());
    for (Eigen::Index k = 0; k < values.rows(); ++k) values(k, i) = named[k].value;
  }
  return values;
}

}  // namespace

ParameterReplicates parameter_replicates(const VectorXd& x, const VectorXd& residuals, const MatrixXd& J,
                                         std::span<const ResidualBlock> blocks, int number, double confidence,
                                         std::uint64_t seed) {
  const WhiteBlocks white = white_blocks(residuals, J, blocks);
  const VectorXd weights = normal_numbers(white.scores.cols() * number, seed);
  MatrixXd deviations = white.back * (white.scores * weights.reshaped(white.scores.cols(), number));
  const double freedom = std::max(static_cast<double>(residuals.size() - x.size()), 1.0);
  ParameterReplicates result;
  VectorXd wider(x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const VectorXd a = white.back.row(j);
    double known = degrees_of_freedom(white, a);
    if (known == 0.0) {
      known = 1.0;
      result.rest_on_one_block = true;
      deviations.row(j) = a.norm() * residuals.norm() / std::sqrt(freedom) *
                          normal_numbers(number, seed + 1 + static_cast<std::uint64_t>(j)).transpose();
    }
    wider[j] = student_quantile(confidence, known) / student_quantile(confidence, 1e9);
  }
  result.around = deviations.colwise() + x;
  result.widened = (wider.asDiagonal() * deviations).colwise() + x;
  return result;
}

void set_intervals(OutputErrorFit& fit, const ParameterCoordinates& coordinates, const ParameterReplicates& replicates,
                   double confidence) {
  const MatrixXd widened = values_of(coordinates, replicates.widened);
  for (Eigen::Index k = 0; k < widened.rows(); ++k) {
    VectorXd sorted = widened.row(k);
    std::ranges::sort(sorted);
    Estimate& estimate = fit.estimates[k];
    const auto at = [&](double part) {
      return sorted[static_cast<Eigen::Index>(std::lround(part * static_cast<double>(sorted.size() - 1)))];
    };
    estimate.lower = at(0.5 - 0.5 * confidence);
    estimate.upper = at(0.5 + 0.5 * confidence);
  }
  const MatrixXd values = values_of(coordinates, replicates.around);
  const MatrixXd centred = values.colwise() - values.rowwise().mean();
  const VectorXd norms = centred.rowwise().norm().cwiseMax(1e-300);
  for (Eigen::Index k = 0; k < values.rows(); ++k)
    fit.estimates[k].standard_error = norms[k] / std::sqrt(static_cast<double>(values.cols() - 1));
  fit.correlation =
      norms.cwiseInverse().asDiagonal() * (centred * centred.transpose()) * norms.cwiseInverse().asDiagonal();
}

}  // namespace pfdm
