#include "solver/calibration/residual_likelihood.h"

#include "physics/random_numbers.h"
#include "solver/linear/dense_algebra.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pfdm {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t n_lengths = 8, n_ratios = 20;
constexpr double shortest = 0.05;        // length, of the range of the places
constexpr double least_ratio = 0.1;      // of the amplitude to the noise
constexpr double most_if_unknown = 1e3;  // of this ratio, where the noise is not known
constexpr double far_out = 4.0;          // times the largest amplitude, where it is

/// Evenly in the logarithm.
std::vector<double> spread_out(double from, double to, std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(n - 1));
  return values;
}

double kernel(double distance, double length) { return std::exp(-0.5 * std::pow(distance / length, 2)); }

/// Weights whose logarithms these are, but for a constant; their sum is 1.
VectorXd weights_of(const VectorXd& logarithms) {
  const VectorXd weights = (logarithms.array() - logarithms.maxCoeff()).exp();
  return weights / weights.sum();
}

double log_sum(const VectorXd& logarithms) {
  const double most = logarithms.maxCoeff();
  return most + std::log((logarithms.array() - most).exp().sum());
}

/// L with L L^T = the covariance of weighted values of the process at the places, but for what rounding leaves
/// (Cholesky's decomposition with pivots: smooth processes have few modes, some 50 of the shortest length).
MatrixXd factor_of(const VectorXd& places, const VectorXd& weights, double length) {
  constexpr double negligible = 1e-10;
  constexpr Eigen::Index most_modes = 300;
  const Eigen::Index n = places.size();
  VectorXd left = weights.array().square();
  const double least = negligible * left.maxCoeff();
  MatrixXd L(n, std::min(n, most_modes));
  Eigen::Index rank = 0;
  for (Eigen::Index pivot = 0; rank < L.cols() && left.maxCoeff(&pivot) > least; ++rank) {
    VectorXd column = L.leftCols(rank) * -L.row(pivot).head(rank).transpose();
    for (Eigen::Index i = 0; i < n; ++i)
      column[i] += weights[i] * weights[pivot] * kernel(places[i] - places[pivot], length);
    L.col(rank) = column / std::sqrt(left[pivot]);
    left = (left.array() - L.col(rank).array().square()).max(0.0);
    left[pivot] = 0.0;
  }
  return L.leftCols(rank);
}

}  // namespace

void IndependentResiduals::emulate(const MatrixXd& coefficients, const VectorXd& variances) {
  squares_ = coefficients * variances.cwiseInverse().asDiagonal() * coefficients.transpose();
}

double IndependentResiduals::logarithm_at(const VectorXd& phi) const { return logarithm(phi.dot(squares_ * phi)); }

double IndependentResiduals::logarithm_of(const VectorXd& residuals) const {
  return logarithm(residuals.squaredNorm());
}

// Where the noise is not known, Student's t with the degrees of freedom that correlation leaves.
double IndependentResiduals::logarithm(double sum_of_squares) const {
  const double w = noise_.widening, sum = std::max(sum_of_squares, 1e-300);
  if (noise_.is_known) return -0.5 * sum / (w * w);
  return -0.5 * (noise_.freedom / (w * w) + noise_.n_parameters) * std::log(sum);
}

ResidualsWithDiscrepancy::ResidualsWithDiscrepancy(const ResidualNoise& noise, const ResidualPlaces& places)
    : noise_(noise),
      places_(VectorXd::Map(places.at.data(), std::ssize(places.at))),
      roots_(VectorXd::Ones(places_.size())) {
  const VectorXd scale = VectorXd::Map(places.scale.data(), std::ssize(places.scale));
  mean_scale_ = scale.mean();
  per_discrepancy_ = mean_scale_ * scale.cwiseInverse();
  const double range = std::max(places_.maxCoeff() - places_.minCoeff(), 1e-300);
  largest_ = places.largest / mean_scale_;
  const double most = noise.is_known ? std::max(far_out * largest_, 2.0 * least_ratio) : most_if_unknown;
  for (const double length : spread_out(shortest * range, range, n_lengths)) modes_.push_back({.length = length});
  for (std::size_t m = 0; m < modes_.size(); ++m)
    for (const double ratio : spread_out(least_ratio, most, n_ratios)) nodes_.push_back({.modes = m, .ratio = ratio});
  find_modes();
}

void ResidualsWithDiscrepancy::find_modes() {
  const VectorXd weights = per_discrepancy_.cwiseQuotient(roots_);
  for (Modes& modes : modes_) {
    const MatrixXd L = factor_of(places_, weights, modes.length);
    const auto [values, vectors] = symmetric_modes(L.transpose() * L);
    modes.values = values.cwiseMax(1e-14 * values.maxCoeff());
    modes.basis = L * vectors * modes.values.cwiseSqrt().cwiseInverse().asDiagonal();
  }
  for (Node& node : nodes_) {
    const Eigen::ArrayXd grown = node.ratio * node.ratio * modes_[node.modes].values.array();
    node.shrink = grown / (1.0 + grown);
    node.half_determinant = 0.5 * grown.log1p().sum();
  }
}

void ResidualsWithDiscrepancy::emulate(const MatrixXd& coefficients, const VectorXd& variances) {
  roots_ = variances.cwiseSqrt();
  find_modes();
  coefficients_ = coefficients * roots_.cwiseInverse().asDiagonal();
  const MatrixXd all = coefficients_ * coefficients_.transpose();
  std::vector<MatrixXd> of_modes;
  for (const Modes& modes : modes_) of_modes.emplace_back(coefficients_ * modes.basis);
  squares_.resize(std::ssize(nodes_), all.size());
  for (Eigen::Index i = 0; i < squares_.rows(); ++i) {
    const MatrixXd& A = of_modes[nodes_[i].modes];
    squares_.row(i) = (all - A * nodes_[i].shrink.asDiagonal() * A.transpose()).reshaped().transpose();
  }
}

// As independent residuals, with the determinant of their covariance and the prior of the amplitude.
double ResidualsWithDiscrepancy::logarithm(const Node& node, double sum_of_squares, double freedom) const {
  const double sum = std::max(sum_of_squares, 1e-300);
  const double variance = noise_.is_known ? 1.0 : sum / freedom;
  const double prior = -0.5 * node.ratio * node.ratio * variance / (largest_ * largest_);
  return (noise_.is_known ? -0.5 * sum : -0.5 * freedom * std::log(sum)) - node.half_determinant + prior;
}

VectorXd ResidualsWithDiscrepancy::sums_at(const VectorXd& phi) const {
  const MatrixXd products = phi * phi.transpose();
  return squares_ * products.reshaped();
}

VectorXd ResidualsWithDiscrepancy::logarithms(const VectorXd& sums) const {
  VectorXd all(sums.size());
  for (Eigen::Index i = 0; i < all.size(); ++i)
    all[i] = logarithm(nodes_[i], sums[i], noise_.freedom + noise_.n_parameters);
  return all;
}

double ResidualsWithDiscrepancy::logarithm_at(const VectorXd& phi) const { return log_sum(logarithms(sums_at(phi))); }

double ResidualsWithDiscrepancy::logarithm_of(const VectorXd& residuals) const {
  const VectorXd r = residuals.cwiseQuotient(roots_);
  std::vector<Eigen::ArrayXd> of_modes;
  for (const Modes& modes : modes_) of_modes.emplace_back((modes.basis.transpose() * r).array().square());
  VectorXd sums = VectorXd::Constant(std::ssize(nodes_), r.squaredNorm());
  for (Eigen::Index i = 0; i < sums.size(); ++i)
    sums[i] -= (nodes_[i].shrink.array() * of_modes[nodes_[i].modes]).sum();
  return log_sum(logarithms(sums));
}

MatrixXd ResidualsWithDiscrepancy::whitened_twice(const Node& node, const MatrixXd& columns) const {
  const MatrixXd& basis = modes_[node.modes].basis;
  return columns - basis * (node.shrink.asDiagonal() * (basis.transpose() * columns));
}

ResidualsWithDiscrepancy::Linear ResidualsWithDiscrepancy::linear(const VectorXd& residuals,
                                                                  const MatrixXd& derivatives,
                                                                  const VectorXd& prior) const {
  std::vector<Linear> all;
  VectorXd logarithms(std::ssize(nodes_));
  for (const Node& node : nodes_) {
    const MatrixXd weighted = whitened_twice(node, derivatives);
    MatrixXd squares = derivatives.transpose() * weighted;
    squares.diagonal() += prior;
    const Eigen::LDLT<MatrixXd> normal(squares);
    const VectorXd change = -normal.solve(weighted.transpose() * residuals);
    const VectorXd left = residuals + derivatives * change;
    const double sum = left.dot(whitened_twice(node, left).col(0));
    const double variance = noise_.is_known ? 1.0 : sum / noise_.freedom;
    const MatrixXd inverse = normal.solve(MatrixXd::Identity(derivatives.cols(), derivatives.cols()));
    logarithms[std::ssize(all)] = logarithm(node, sum, noise_.freedom) - 0.5 * normal.vectorD().array().log().sum();
    all.push_back({change, variance * inverse, variance});
  }
  const VectorXd weights = weights_of(logarithms);
  const Eigen::Index k = derivatives.cols();
  Linear mean{VectorXd::Zero(k), MatrixXd::Zero(k, k), 0.0};
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    mean.change += weights[i] * all[i].change;
    mean.variance += weights[i] * all[i].variance;
  }
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const VectorXd off = all[i].change - mean.change;
    mean.covariance += weights[i] * (all[i].covariance + off * off.transpose());
  }
  return mean;
}

// The process at `at` under one length and amplitude: its mean is -`gain`^T residuals, in units of the mean scale.
struct ResidualsWithDiscrepancy::Prediction {
  MatrixXd gain;      // (residuals, places)
  VectorXd variance;  // over that of the noise
};

ResidualsWithDiscrepancy::Prediction ResidualsWithDiscrepancy::predict(const Node& node, const VectorXd& at) const {
  const double square = node.ratio * node.ratio;
  MatrixXd shared(places_.size(), at.size());
  for (Eigen::Index j = 0; j < at.size(); ++j)
    for (Eigen::Index i = 0; i < places_.size(); ++i)
      shared(i, j) = per_discrepancy_[i] / roots_[i] * square * kernel(places_[i] - at[j], modes_[node.modes].length);
  Prediction to{.gain = whitened_twice(node, shared), .variance = {}};
  to.variance = (square - shared.cwiseProduct(to.gain).colwise().sum().transpose().array()).max(0.0);
  return to;
}

ModelDiscrepancy ResidualsWithDiscrepancy::found(const std::vector<VectorXd>& phis, std::uint64_t seed) const {
  constexpr Eigen::Index n_places = 61;
  RandomNumbers random(seed);
  const VectorXd at = VectorXd::LinSpaced(n_places, places_.minCoeff(), places_.maxCoeff());
  std::map<Eigen::Index, Prediction> predictions;
  std::vector<double> amplitudes, lengths;
  std::vector<std::vector<double>> errors(n_places);
  for (const VectorXd& phi : phis) {
    const VectorXd sums = sums_at(phi), weights = weights_of(logarithms(sums));
    Eigen::Index drawn = 0;
    for (double rest = random.uniform() - weights[0]; rest > 0.0 && drawn + 1 < weights.size();)
      rest -= weights[++drawn];
    const Node& node = nodes_[drawn];
    const double variance = noise_.is_known ? 1.0 : sums[drawn] / (noise_.freedom + noise_.n_parameters);
    const double noise = mean_scale_ * std::sqrt(variance);
    amplitudes.push_back(node.ratio * noise);
    lengths.push_back(modes_[node.modes].length);
    if (!predictions.contains(drawn)) predictions[drawn] = predict(node, at);
    const Prediction& prediction = predictions[drawn];
    const VectorXd mean = -mean_scale_ * (prediction.gain.transpose() * (coefficients_.transpose() * phi));
    for (Eigen::Index j = 0; j < n_places; ++j)
      errors[j].push_back(mean[j] + noise * std::sqrt(prediction.variance[j]) * random.normal());
  }
  ModelDiscrepancy result{
      .amplitude = interval_of(amplitudes), .length = interval_of(lengths), .at = {at.begin(), at.end()}};
  for (const std::vector<double>& of_place : errors) {
    const SampledInterval interval = interval_of(of_place);
    result.median.push_back(interval.median);
    result.lower.push_back(interval.lower);
    result.upper.push_back(interval.upper);
  }
  return result;
}

}  // namespace pfdm
