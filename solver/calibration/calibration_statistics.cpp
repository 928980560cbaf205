#include "solver/calibration/calibration_statistics.h"

#include "physics/error.h"
#include "solver/calibration/levenberg_marquardt.h"
#include "solver/linear/dense_algebra.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double unseen = 1e-9;  // sensitivity of the residuals, relative to the largest
constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<std::string> names_of(const ScaledModel& model, const std::vector<std::size_t>& which) {
  std::vector<std::string> names;
  names.reserve(which.size());
  for (const std::size_t j : which) names.push_back(model.problem().parameters[j].name);
  return names;
}

/// Parameters that the estimate of a covariance can rest on; warns of the others.
std::vector<std::size_t> visible_parameters(const ScaledModel& model, const Eigen::MatrixXd& J, FitResult& result) {
  std::vector<std::size_t> visible;
  const double largest = J.colwise().norm().maxCoeff();
  for (std::size_t j = 0; j < model.n_parameters(); ++j) {
    const std::string& name = model.problem().parameters[j].name;
    if (!(J.col(j).norm() > unseen * largest))
      result.warnings.push_back(
          fmt::format("the data do not determine {}: it has no influence on the residuals", name));
    else if (result.estimates[j].at_bound)
      result.warnings.push_back(
          fmt::format("{} is at its bound; the intervals of the others are conditional on it", name));
    else
      visible.push_back(j);
  }
  return visible;
}

/// (J^T J)^-1 of the visible columns by singular values of the normalised columns; directions that the data do not
/// determine are left out and named, their parameters marked.
Eigen::MatrixXd inverse_normal(const ScaledModel& model, const Eigen::MatrixXd& J,
                               const std::vector<std::size_t>& visible, std::vector<bool>& undetermined,
                               FitResult& result) {
  const auto n = static_cast<Eigen::Index>(visible.size());
  if (n == 0) return Eigen::MatrixXd::Zero(0, 0);
  Eigen::MatrixXd A(J.rows(), n);
  for (Eigen::Index k = 0; k < n; ++k) A.col(k) = J.col(visible[k]);
  const Eigen::VectorXd size = A.colwise().norm();
  A = A * size.cwiseInverse().asDiagonal();
  const SingularValues svd = singular_values(A);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double sigma = svd.values[k];
    const Eigen::VectorXd v = svd.V.col(k);
    if (sigma > model.exactness() * svd.values[0]) {
      inverse += v * v.transpose() / (sigma * sigma);
      continue;
    }
    std::vector<std::size_t> together;
    for (Eigen::Index i = 0; i < n; ++i)
      if (std::abs(v[i]) > 0.1) {
        together.push_back(visible[i]);
        undetermined[visible[i]] = true;
      }
    result.warnings.push_back(
        fmt::format("the data determine only a combination of {}", fmt::join(names_of(model, together), ", ")));
  }
  return size.cwiseInverse().asDiagonal() * inverse * size.cwiseInverse().asDiagonal();
}

/// About u; about the point of the grid where the model has no answer beside u, and a warning.
std::optional<Eigen::MatrixXd> jacobian_at_end(const ScaledModel& model, const Eigen::VectorXd& u, FitResult& result) {
  if (auto J = model.jacobian_at_end(u)) return J;
  const Eigen::VectorXd centre = model.centre_of_differences(u);
  if (centre == u) return std::nullopt;
  auto J = model.jacobian(u);
  if (J)
    result.warnings.push_back(
        fmt::format("intervals are by differences about the nearest point of the grid ({:.6g}): the model does not "
                    "converge beside the estimates",
                    fmt::join(model.natural(centre), ", ")));
  return J;
}

void set_interval(const ScaledModel& model, std::size_t j, double u, double error, double t, FitEstimate& estimate) {
  const double reach = t * error;
  estimate.lower_95 = model.natural(j, u - reach);
  estimate.upper_95 = model.natural(j, u + reach);
  estimate.standard_error = error * (model.is_log(j) ? estimate.value : model.scale(j));
  if (std::isfinite(error)) return;
  estimate.lower_95 = model.problem().parameters[j].lower;
  estimate.upper_95 = model.problem().parameters[j].upper;
}

void warn_of_poor_estimates(const ScaledModel& model, FitResult& result) {
  for (std::size_t j = 0; j < model.n_parameters(); ++j) {
    const FitEstimate& e = result.estimates[j];
    if (std::isfinite(e.standard_error) && e.standard_error > std::abs(e.value))
      result.warnings.push_back(fmt::format("{} is poorly determined: standard error {:.3g} of the estimate {:.3g}",
                                            model.problem().parameters[j].name, e.standard_error, e.value));
    for (std::size_t i = 0; i < j; ++i) {
      const double r = result.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(r) > 0.99)
        result.warnings.push_back(fmt::format("{} and {} are strongly correlated ({:.4f})",
                                              model.problem().parameters[i].name, model.problem().parameters[j].name,
                                              r));
    }
  }
}

/// From scaled parameters to parameters. `inverse`: of the visible ones.
void set_linear_model(const ScaledModel& model, const Eigen::MatrixXd& J, const std::vector<std::size_t>& visible,
                      const Eigen::MatrixXd& inverse, FitResult& result) {
  const auto n = static_cast<Eigen::Index>(model.n_residuals()), k = static_cast<Eigen::Index>(model.n_parameters());
  Eigen::VectorXd scale(k);
  for (Eigen::Index j = 0; j < k; ++j) scale[j] = model.scale(static_cast<std::size_t>(j));
  result.derivatives = J.topRows(n) * scale.cwiseInverse().asDiagonal();
  result.inverse_normal = Eigen::MatrixXd::Zero(k, k);
  for (std::size_t a = 0; a < visible.size(); ++a)
    for (std::size_t b = 0; b < visible.size(); ++b) {
      const auto i = static_cast<Eigen::Index>(visible[a]), j = static_cast<Eigen::Index>(visible[b]);
      result.inverse_normal(i, j) =
          inverse(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) * scale[i] * scale[j];
    }
}

void set_correlation(FitResult& result) {
  const Eigen::VectorXd error = result.covariance.diagonal().cwiseSqrt();
  result.correlation = Eigen::MatrixXd::Identity(error.size(), error.size());
  for (Eigen::Index i = 0; i < error.size(); ++i)
    for (Eigen::Index j = 0; j < error.size(); ++j)
      if (i != j && error[i] > 0.0 && error[j] > 0.0 && std::isfinite(error[i] * error[j]))
        result.correlation(i, j) = result.covariance(i, j) / (error[i] * error[j]);
}

}  // namespace

double student_quantile(double confidence, double degrees_of_freedom) {
  if (!(degrees_of_freedom > 0.0)) return infinite;
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.5 + 0.5 * confidence);
}

double student_95(double degrees_of_freedom) { return student_quantile(0.95, degrees_of_freedom); }

void add_statistics(const ScaledModel& model, const Eigen::VectorXd& u, FitResult& result) {
  const auto r = model.residuals(u);
  const auto J = jacobian_at_end(model, u, result);
  if (!r || !J) throw NoConvergence("the model does not converge at the fitted parameters");
  const std::size_t n = model.n_residuals(), k = model.n_parameters();
  result.residuals.assign(r->begin(), r->begin() + n);
  for (const double value : result.residuals) result.sum_of_squares += value * value;
  result.rms = std::sqrt(result.sum_of_squares / static_cast<double>(n));
  result.estimates.resize(k);
  const std::vector<double> values = model.natural(u);
  for (std::size_t j = 0; j < k; ++j) {
    result.estimates[j].value = values[j];
    result.estimates[j].at_bound = side_of_bound(u[j], model.bounds(j)) != 0;
  }
  const std::vector<std::size_t> visible = visible_parameters(model, *J, result);
  std::vector<bool> undetermined(k, false);
  const Eigen::MatrixXd inverse = inverse_normal(model, *J, visible, undetermined, result);
  const double freedom = static_cast<double>(r->size()) - static_cast<double>(visible.size());
  double total = 0.0;
  for (const double value : *r) total += value * value;
  const double variance = model.problem().noise_is_known ? 1.0 : freedom > 0.0 ? total / freedom : infinite;
  const double t = model.problem().noise_is_known ? student_95(1e9) : student_95(freedom);

  set_linear_model(model, *J, visible, inverse, result);
  result.covariance = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
  for (const std::size_t a : visible)
    for (const std::size_t b : visible) {
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      result.covariance(i, j) = variance * result.inverse_normal(i, j);
    }
  for (std::size_t j = 0; j < k; ++j) {
    const auto index = static_cast<Eigen::Index>(j);
    const bool known = std::ranges::count(visible, j) > 0 && !undetermined[j];
    const double error = known ? std::sqrt(result.covariance(index, index)) / model.scale(j) : infinite;
    if (!known) result.covariance(index, index) = infinite;
    set_interval(model, j, u[index], error, t, result.estimates[j]);
  }
  set_correlation(result);
  warn_of_poor_estimates(model, result);
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[at];
}

SampledInterval interval_of(const std::vector<double>& samples) {
  return {quantile(samples, 0.5), quantile(samples, 0.025), quantile(samples, 0.975)};
}

double effective_number(const std::vector<Eigen::VectorXd>& chain) {
  constexpr std::size_t n_stretches = 20;
  const std::size_t length = chain.size() / n_stretches;
  const auto n = static_cast<double>(chain.size());
  double least = n;
  for (Eigen::Index j = 0; j < chain.front().size(); ++j) {
    double mean = 0.0, squares = 0.0, of_stretches = 0.0;
    for (const Eigen::VectorXd& z : chain) mean += z[j] / n;
    for (const Eigen::VectorXd& z : chain) squares += std::pow(z[j] - mean, 2) / n;
    for (std::size_t s = 0; s < n_stretches; ++s) {
      double of_stretch = 0.0;
      for (std::size_t i = 0; i < length; ++i) of_stretch += chain[s * length + i][j] / static_cast<double>(length);
      of_stretches += std::pow(of_stretch - mean, 2) / static_cast<double>(n_stretches - 1);
    }
    if (!(squares > 0.0)) return 0.0;
    least = std::min(least, n * squares / std::max(static_cast<double>(length) * of_stretches, squares));
  }
  return least;
}

}  // namespace pfdm
