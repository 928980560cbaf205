#pragma once
// Parameters of a fit over their first guess, or as logarithms of that ratio, and the model as a function of them.

#include "solver/calibration/calibration.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace pfdm {

class ScaledModel {
 public:
  ScaledModel(const FitProblem& problem, const FitSettings& settings);

  std::size_t n_parameters() const { return problem_.parameters.size(); }
  /// Without priors; known after the first evaluation, 0 before.
  std::size_t n_residuals() const { return n_residuals_; }
  const FitProblem& problem() const { return problem_; }
  bool is_log(std::size_t j) const { return problem_.parameters[j].log_scale; }
  int evaluations() const { return evaluations_; }
  double exactness() const { return settings_.exactness; }

  Eigen::VectorXd first() const;
  Eigen::VectorXd start() const;
  std::vector<double> natural(const Eigen::VectorXd& u) const;
  double natural(std::size_t j, double u) const;
  std::pair<double, double> bounds(std::size_t j) const;
  /// From parameters to scaled ones.
  Eigen::VectorXd from(const std::vector<double>& parameters) const;
  /// Of two points, both given as parameters, in scaled ones.
  double distance(const std::vector<double>& a, const std::vector<double>& b) const {
    return (from(a) - from(b)).norm();
  }
  /// The parameters; nothing if one is beyond its bounds.
  std::optional<std::vector<double>> within_bounds(const Eigen::VectorXd& u) const;
  double scale(std::size_t j) const { return scale_[j]; }  ///< parameter over scaled one; 1 on a logarithmic scale

  /// Of the data, then of the priors.
  std::optional<std::vector<double>> residuals(const Eigen::VectorXd& u) const;
  std::optional<Eigen::MatrixXd> jacobian(const Eigen::VectorXd& u) const;
  /// By differences about u itself, also if the settings share them: central ones, or forward ones where the settings
  /// say so. The latest is kept.
  std::optional<Eigen::MatrixXd> jacobian_about(const Eigen::VectorXd& u) const;
  /// That of the intervals.
  std::optional<Eigen::MatrixXd> jacobian_at_end(const Eigen::VectorXd& u) const {
    return settings_.ends_on_grid ? jacobian(u) : jacobian_about(u);
  }
  /// About which differences are taken: u, or the nearest point of the grid.
  Eigen::VectorXd centre_of_differences(const Eigen::VectorXd& u) const;
  /// Half the sum of the squares, priors included; infinite where the model does not converge.
  double cost(const Eigen::VectorXd& u) const;
  /// Of that many residuals as there are without priors.
  double rms(double cost) const {
    return std::sqrt(2.0 * cost / static_cast<double>(std::max<std::size_t>(1, n_residuals())));
  }
  /// Tells the model that these points are asked for next.
  void prepare(const std::vector<Eigen::VectorXd>& points) const;

 private:
  std::optional<Eigen::MatrixXd> given_jacobian(const Eigen::VectorXd& u) const;
  std::optional<std::vector<double>> evaluated(const Residuals& model, const Eigen::VectorXd& u) const;
  const Residuals& smooth() const { return problem_.averaged ? problem_.averaged : problem_.residuals; }
  std::optional<Eigen::MatrixXd> differences(const Residuals& model, const Eigen::VectorXd& centre) const;
  /// Where parameter j is moved by `sign` steps; nothing beyond its bounds.
  std::optional<Eigen::VectorXd> moved(const Eigen::VectorXd& u, std::size_t j, double sign) const;
  double step_of(double u) const { return settings_.step * std::max(1.0, std::abs(u)); }
  std::optional<Eigen::VectorXd> difference(const Residuals& model, const Eigen::VectorXd& u,
                                            const std::vector<double>& here, std::size_t j) const;
  double scaled(std::size_t j, double parameter) const;

  const FitProblem& problem_;
  const FitSettings& settings_;
  std::vector<double> scale_;
  mutable std::atomic<std::size_t> n_residuals_{0};
  mutable std::atomic<int> evaluations_{0};
  mutable Eigen::VectorXd known_at_;  // of known_
  mutable Eigen::MatrixXd known_;     // the latest Jacobian about a point itself
};

}  // namespace pfdm
