#pragma once
// How likely residuals are: independent noise, or noise and a model discrepancy.
//
// Model discrepancy (Kennedy, O'Hagan, J. R. Stat. Soc. B 63 (2001) 425): what the model lacks is a function of the
// place, as of the displacement, that all data share: a Gaussian process of mean zero whose covariance between two
// places is s^2 exp(-(x - x')^2 / (2 l^2)). Its amplitude s has the prior exp(-(s/A)^2/2) / s from a tenth of the noise
// on, A a likely largest one. Its length l has the prior 1/l from a twentieth of the range of the places to the whole.
// Both are summed over on a grid. Parameters that such a function could stand in for become uncertain (Brynjarsdottir,
// O'Hagan, Inverse Problems 30 (2014) 114007): what the data cannot tell is not told.

#include "solver/calibration/calibration_statistics.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pfdm {

/// Noise of residuals; where it is not known its standard deviation has the prior 1/s and is integrated over.
struct ResidualNoise {
  bool is_known = false;  ///< and the residuals are divided by its standard deviation
  double freedom = 1.0;   ///< numbers of residuals less parameters
  double n_parameters = 0.0;
  double widening = 1.0;  ///< of standard errors, for correlated residuals
};

class ResidualLikelihood {
 public:
  virtual ~ResidualLikelihood() = default;
  /// Takes coefficients^T phi for the residuals from now on, with these variances over that of the noise
  /// (ResidualEmulator).
  virtual void emulate(const Eigen::MatrixXd& coefficients, const Eigen::VectorXd& variances) = 0;
  /// Logarithm, but for a constant: of coefficients^T phi, and of residuals of the model itself.
  virtual double logarithm_at(const Eigen::VectorXd& phi) const = 0;
  virtual double logarithm_of(const Eigen::VectorXd& residuals) const = 0;
};

class IndependentResiduals : public ResidualLikelihood {
 public:
  explicit IndependentResiduals(const ResidualNoise& noise) : noise_(noise) {}
  void emulate(const Eigen::MatrixXd& coefficients, const Eigen::VectorXd& variances) override;
  double logarithm_at(const Eigen::VectorXd& phi) const override;
  double logarithm_of(const Eigen::VectorXd& residuals) const override;

 private:
  double logarithm(double sum_of_squares) const;

  ResidualNoise noise_;
  Eigen::MatrixXd squares_;
};

/// Where the residuals are, and what they are divided by.
struct ResidualPlaces {
  std::vector<double> at;     ///< place of each, as the displacement
  std::vector<double> scale;  ///< unit of each [that of the data]
  double largest = 1.0;       ///< A, positive [that of the data]
};

/// What is found of a discrepancy, at places from the first to the last: 95 % of its posterior.
struct ModelDiscrepancy {
  SampledInterval amplitude{};                     ///< s [that of the data]
  SampledInterval length{};                        ///< l [that of the places]
  std::vector<double> at{};                        ///< places
  std::vector<double> median{}, lower{}, upper{};  ///< measured less computed [that of the data]
};

class ResidualsWithDiscrepancy : public ResidualLikelihood {
 public:
  ResidualsWithDiscrepancy(const ResidualNoise& noise, const ResidualPlaces& places);
  void emulate(const Eigen::MatrixXd& coefficients, const Eigen::VectorXd& variances) override;
  double logarithm_at(const Eigen::VectorXd& phi) const override;
  double logarithm_of(const Eigen::VectorXd& residuals) const override;

  /// Estimates and their covariance, if the residuals are linear in what is fitted: the data say less of parameters
  /// that the discrepancy may stand in for. Before emulate(). `prior`: inverse variances of the parameters' priors,
  /// times the variance of the noise.
  struct Linear {
    Eigen::VectorXd change;  ///< of the estimates
    Eigen::MatrixXd covariance;
    double variance = 1.0;  ///< of the noise [that of the residuals]
  };
  Linear linear(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& derivatives,
                const Eigen::VectorXd& prior) const;
  /// By samples of the posterior, given as their phi.
  ModelDiscrepancy found(const std::vector<Eigen::VectorXd>& phis, std::uint64_t seed) const;

 private:
  /// Of one length: covariance of what a process of variance 1 adds to residuals = basis diag(values) basis^T.
  struct Modes {
    double length = 0.0;
    Eigen::MatrixXd basis{};
    Eigen::VectorXd values{};
  };
  /// A length and an amplitude.
  struct Node {
    std::size_t modes = 0;
    double ratio = 0.0;             // of the amplitude to the standard deviation of the noise, of mean scale
    Eigen::VectorXd shrink{};       // the inverse covariance is 1 - basis diag(shrink) basis^T
    double half_determinant = 0.0;  // half its logarithm, of the covariance
  };
  struct Prediction;
  void find_modes();
  double logarithm(const Node& node, double sum_of_squares, double freedom) const;
  /// Residuals^T inverse covariance residuals, of every node; and the logarithms of their likelihoods.
  Eigen::VectorXd sums_at(const Eigen::VectorXd& phi) const;
  Eigen::VectorXd logarithms(const Eigen::VectorXd& sums) const;
  /// Inverse covariance times columns.
  Eigen::MatrixXd whitened_twice(const Node& node, const Eigen::MatrixXd& columns) const;
  Prediction predict(const Node& node, const Eigen::VectorXd& at) const;

  ResidualNoise noise_;
  Eigen::VectorXd places_;             // of the residuals
  Eigen::VectorXd per_discrepancy_{};  // what a discrepancy of the mean scale adds to each residual
  Eigen::VectorXd roots_;              // of the residuals' variances: they are divided by these
  Eigen::MatrixXd coefficients_{};
  Eigen::MatrixXd squares_{};  // sums_at(phi) = squares_ (all products of two of phi), a row each
  double mean_scale_ = 1.0;
  double largest_ = 0.0;  // A, over the mean scale
  std::vector<Modes> modes_{};
  std::vector<Node> nodes_{};
};

}  // namespace pfdm
