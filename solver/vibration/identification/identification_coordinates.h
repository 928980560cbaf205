#pragma once
// Coordinates in which a fit moves the parameters of the mass-material model.

#include "solver/vibration/identification/identification_values.h"

#include <Eigen/Core>

#include <optional>
#include <utility>
#include <vector>

namespace pfdm {

/// Of size one without bounds: logarithms of what must be positive (k1, c, |beta|), a sigmoid of what has two bounds
/// (lambda; the logarithm of alpha), k_i relative to k1 at the displacement that occurs.
class ParameterCoordinates {
 public:
  /// `terms` says which parameters there are. The kernel's rates stay within ten times the excited band.
  ParameterCoordinates(const MassMaterial& terms, const ExcitedRange& range);

  Eigen::VectorXd from(const MassMaterial& model) const;
  MassMaterial model(const Eigen::VectorXd& x) const;

  /// Of the entries of x: what must be positive may become so small that nobody would notice it, but not vanish, which
  /// a logarithm would follow without end.
  std::vector<std::pair<double, double>> bounds(const MassMaterial& start) const;

  /// Says of each of the model's named values how far the search could move it, and whether it went so far.
  void set_bounds(const MassMaterial& model, std::vector<Estimate>& values) const;

 private:
  static double beta_like_stiffness(const MassMaterial& m, double alpha);
  bool free_exponent() const { return terms_.damping_exponent != 0.0; }

  MassMaterial terms_;
  double displacement_;  // [m]
  double log_low_;
  double log_high_;
};

/// Puts the slowest kernel term first: a convention, so that estimates can be compared.
void sort_terms(MassMaterial& m);

/// Columns of the coordinates in the order in which the terms' rates rise; none if they already do. The rates may have
/// passed each other during a search.
std::optional<std::vector<Eigen::Index>> rising_order(const MassMaterial& m, Eigen::Index n_coordinates);

}  // namespace pfdm
