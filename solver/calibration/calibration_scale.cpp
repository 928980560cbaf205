#include "solver/calibration/calibration_scale.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

/// A first guess of zero says nothing about the size: the bounds may.
double scale_of(const FitParameter& p) {
  if (p.log_scale) return 1.0;
  if (p.first != 0.0) return std::abs(p.first);
  const double width = p.upper - p.lower;
  return std::isfinite(width) ? width : 1.0;
}

}  // namespace

ScaledModel::ScaledModel(const FitProblem& problem, const FitSettings& settings)
    : problem_(problem), settings_(settings) {
  for (const FitParameter& p : problem.parameters) scale_.push_back(scale_of(p));
}

double ScaledModel::scaled(std::size_t j, double parameter) const {
  const FitParameter& p = problem_.parameters[j];
  if (!p.log_scale) return parameter / scale_[j];
  return parameter > 0.0 ? std::log(parameter / p.first) : -std::numeric_limits<double>::infinity();
}

double ScaledModel::natural(std::size_t j, double u) const {
  const FitParameter& p = problem_.parameters[j];
  return p.log_scale ? p.first * std::exp(u) : scale_[j] * u;
}

Eigen::VectorXd ScaledModel::from(const std::vector<double>& parameters) const {
  Eigen::VectorXd u(static_cast<Eigen::Index>(n_parameters()));
  for (std::size_t j = 0; j < n_parameters(); ++j) u[j] = scaled(j, parameters[j]);
  return u;
}

std::optional<std::vector<double>> ScaledModel::within_bounds(const Eigen::VectorXd& u) const {
  for (std::size_t j = 0; j < n_parameters(); ++j) {
    const auto [lower, upper] = bounds(j);
    const double value = u[j];
    if (value < lower || value > upper) return std::nullopt;
  }
  return natural(u);
}

Eigen::VectorXd ScaledModel::first() const {
  std::vector<double> values;
  for (const FitParameter& p : problem_.parameters) values.push_back(p.first);
  return from(values);
}

Eigen::VectorXd ScaledModel::start() const {
  Eigen::VectorXd u = first();
  for (std::size_t j = 0; j < n_parameters(); ++j)
    if (const auto& start = problem_.parameters[j].start) u[j] = scaled(j, *start);
  return u;
}

std::vector<double> ScaledModel::natural(const Eigen::VectorXd& u) const {
  std::vector<double> parameters;
  for (std::size_t j = 0; j < n_parameters(); ++j) parameters.push_back(natural(j, u[j]));
  return parameters;
}

std::pair<double, double> ScaledModel::bounds(std::size_t j) const {
  return {scaled(j, problem_.parameters[j].lower), scaled(j, problem_.parameters[j].upper)};
}

std::optional<std::vector<double>> ScaledModel::residuals(const Eigen::VectorXd& u) const {
  return evaluated(problem_.residuals, u);
}

std::optional<std::vector<double>> ScaledModel::evaluated(const Residuals& model, const Eigen::VectorXd& u) const {
  ++evaluations_;
  auto r = model(natural(u));
  if (!r) return std::nullopt;
  for (const double value : *r)
    if (!std::isfinite(value)) return std::nullopt;
  const std::size_t before = n_residuals_.exchange(r->size());
  if (before != 0 && before != r->size())
    throw ComputationError(fmt::format("the number of the model's residuals changed from {} to {}", before, r->size()));
  for (std::size_t j = 0; j < n_parameters(); ++j)
    if (const auto& prior = problem_.parameters[j].prior)
      r->push_back((u[j] - scaled(j, prior->mean)) * scale_[j] / prior->standard_deviation);
  return r;
}

double ScaledModel::cost(const Eigen::VectorXd& u) const {
  const auto r = residuals(u);
  if (!r) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const double value : *r) sum += value * value;
  return 0.5 * sum;
}

std::optional<Eigen::MatrixXd> ScaledModel::jacobian(const Eigen::VectorXd& u) const {
  if (problem_.jacobian) return given_jacobian(u);
  return differences(smooth(), centre_of_differences(u));
}

std::optional<Eigen::MatrixXd> ScaledModel::jacobian_about(const Eigen::VectorXd& u) const {
  if (problem_.jacobian) return given_jacobian(u);
  if (known_at_.size() == u.size() && known_at_ == u) return known_;
  auto J = differences(smooth(), u);
  if (J) known_at_ = u, known_ = *J;
  return J;
}

std::optional<Eigen::MatrixXd> ScaledModel::given_jacobian(const Eigen::VectorXd& u) const {
  const std::vector<double> parameters = natural(u);
  const auto given = problem_.jacobian(parameters);
  if (!given || !given->allFinite()) return std::nullopt;
  Eigen::MatrixXd J = *given;
  for (std::size_t j = 0; j < n_parameters(); ++j) J.col(j) *= is_log(j) ? parameters[j] : scale_[j];
  for (std::size_t j = 0; j < n_parameters(); ++j)
    if (const auto& prior = problem_.parameters[j].prior) {
      J.conservativeResize(J.rows() + 1, Eigen::NoChange);
      J.row(J.rows() - 1).setZero();
      J(J.rows() - 1, static_cast<Eigen::Index>(j)) = scale_[j] / prior->standard_deviation;
    }
  return J;
}

void ScaledModel::prepare(const std::vector<Eigen::VectorXd>& points) const {
  if (!problem_.prepare) return;
  std::vector<std::vector<double>> parameters;
  parameters.reserve(points.size());
  for (const Eigen::VectorXd& u : points) parameters.push_back(natural(u));
  problem_.prepare(parameters);
}

std::optional<Eigen::VectorXd> ScaledModel::moved(const Eigen::VectorXd& u, std::size_t j, double sign) const {
  Eigen::VectorXd result = u;
  double& entry = result[j];
  entry += sign * step_of(entry);
  const auto [lower, upper] = bounds(j);
  return entry > upper || entry < lower ? std::nullopt : std::optional(result);
}

/// Central where both sides can be evaluated, else to the side that can.
std::optional<Eigen::VectorXd> ScaledModel::difference(const Residuals& model, const Eigen::VectorXd& u,
                                                       const std::vector<double>& here, std::size_t j) const {
  const double h = step_of(u[j]);
  const auto side = [&](double sign) {
    const auto there = moved(u, j, sign);
    return there ? evaluated(model, *there) : std::nullopt;
  };
  const auto above = side(1.0);
  const auto below = above && settings_.differences == Differences::forward ? std::nullopt : side(-1.0);
  if (!above && !below) return std::nullopt;
  const auto as_vector = [](const std::vector<double>& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  const double width = (above ? h : 0.0) + (below ? h : 0.0);
  return (as_vector(above ? *above : here) - as_vector(below ? *below : here)) / width;
}

Eigen::VectorXd ScaledModel::centre_of_differences(const Eigen::VectorXd& u) const {
  if (settings_.differences != Differences::shared) return u;
  Eigen::VectorXd centre = first();
  for (std::size_t j = 0; j < n_parameters(); ++j) {
    const auto index = static_cast<Eigen::Index>(j);
    const double h = step_of(centre[index]);
    const auto [lower, upper] = bounds(j);
    centre[index] = std::clamp(centre[index] + h * std::round((u[index] - centre[index]) / h), lower, upper);
  }
  return centre;
}

std::optional<Eigen::MatrixXd> ScaledModel::differences(const Residuals& model, const Eigen::VectorXd& u) const {
  std::vector<Eigen::VectorXd> points{u};
  for (std::size_t j = 0; j < n_parameters(); ++j) {
    const auto above = moved(u, j, 1.0);
    const auto below = above && settings_.differences == Differences::forward ? std::nullopt : moved(u, j, -1.0);
    for (const auto& point : {above, below})
      if (point) points.push_back(*point);
  }
  prepare(points);
  const auto here = evaluated(model, u);
  if (!here) return std::nullopt;
  std::vector<std::optional<Eigen::VectorXd>> columns(n_parameters());
  const auto n = static_cast<Index>(n_parameters());
  const auto body = [&](Index begin, Index end) {
    for (Index j = begin; j < end; ++j) columns[j] = difference(model, u, *here, static_cast<std::size_t>(j));
  };
  if (settings_.side_by_side)
    parallel_chunks(n, body, 1);
  else
    body(0, n);
  Eigen::MatrixXd J(static_cast<Eigen::Index>(here->size()), static_cast<Eigen::Index>(n_parameters()));
  for (std::size_t j = 0; j < n_parameters(); ++j) {
    if (!columns[j]) return std::nullopt;
    J.col(j) = *columns[j];
  }
  return J;
}

}  // namespace pfdm
