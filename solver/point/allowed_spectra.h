#pragma once
// What tests leave open of the complex modulus, whatever the number of branches: the least and the largest value that
// any spectrum of relaxation times gives whose sum of squares is little above the least of all,
//
//   min, max c(x)  subject to  |A x - b|^2 <= min_x |A x - b|^2 + allowance,  x >= 0,
//
// with the relaxed modulus and the moduli x of a fine grid of times, and the times of a fit. The problem is convex.
// Ends are exact on the grid where what was measured is linear in the moduli, as stresses at given strains and moduli
// in shear, else to first order (Rust, O'Leary, Confidence intervals for discrete approximations to ill-posed problems,
// J. Comput. Graph. Stat. 3 (1994) 67; Stark, J. Geophys. Res. 97 (1992) 14055).

#include "solver/point/viscoelastic_fit.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pfdm {

/// Times the allowance of one unconstrained figure, 1.96^2, for intervals of 95 %: chi-square with two degrees of
/// freedom. With moduli that cannot be negative 1.96^2 alone is too little (Batlle, Stanley, Patil, Kuusela, Owhadi,
/// arXiv:2310.02461, on the conjecture of Burrus): of loss moduli it held 90 %, with spectra of two branches and of a
/// stretched exponential (cases/binder_rates/README.md).
inline constexpr double constrained_allowance = 5.99 / 3.84;

/// Relaxation moduli in tension and shear of a law.
struct LawModuli {
  RelaxationModulus young, shear;
};
/// A number of them, such as the storage modulus in shear at a frequency.
using ModuliFigure = std::function<double(const LawModuli&)>;

/// How far the grid of times reaches beyond the window of the data, as factors. Branches beyond a hundred times look
/// like rest, or like a dashpot.
struct SpectrumReach {
  double faster = 100.0, slower = 100.0;
};

/// End of what a figure can be, and a spectrum that has it.
struct SpectrumExtreme {
  double value = 0.0;
  PronyLaw law;
};

/// Tension, creep and loss factors are taken to first order about the spectrum that meets the data best. The bulk
/// modulus is that of the fit; where Poisson's ratio is estimated it is free.
class AllowedSpectra {
 public:
  /// `fit`: one of branches, whose moduli are estimated; `deviations`: of each measured value.
  AllowedSpectra(const ViscoelasticFit& fit, const ViscoelasticExperiments& experiments,
                 std::span<const double> deviations, const SpectrumReach& reach = {});

  /// Whether the spectrum that meets the data best was found. Without it there are no ends.
  bool is_least() const { return is_least_; }
  double least_sum() const { return least_sum_; }  ///< of squares, of any spectrum
  const PronyLaw& best() const { return best_; }   ///< the spectrum that has it

  /// Ends with a sum of squares of least_sum() + allowance; nothing where the data leave a figure open: above a
  /// hundred times that of the best spectrum.
  std::optional<SpectrumExtreme> lowest(const ModuliFigure& figure, double allowance) const;
  std::optional<SpectrumExtreme> highest(const ModuliFigure& figure, double allowance) const;

 private:
  /// With an amount more of unknown j.
  PronyLaw beside(const PronyLaw& law, Eigen::Index j, double amount) const;
  PronyLaw law_of(const Eigen::VectorXd& x) const;
  /// To the least sum of squares, from the fit.
  void descend(const ViscoelasticExperiments& experiments, std::span<const double> deviations);
  void linearise(const ViscoelasticExperiments& experiments, std::span<const double> deviations);
  Eigen::VectorXd slopes_of(const ModuliFigure& figure) const;
  std::optional<SpectrumExtreme> end_of(const ModuliFigure& figure, double allowance, double sign) const;

  PronyLaw given_;  // of the fit, whose relaxed modulus and Poisson's ratio may be held
  bool holds_relaxed_ = false, holds_poisson_ratio_ = true;
  std::vector<double> times_;
  double scale_ = 0.0;  // of the moduli [Pa]: unknowns are in parts of it
  PronyLaw best_;
  Eigen::VectorXd x_;  // of best_: relaxed modulus, moduli at the times, bulk modulus above and below the given one
  Eigen::MatrixXd R_;  // |R x - right|^2: the sum of squares
  Eigen::VectorXd right_;
  Eigen::VectorXd amounts_;  // of the unknowns, for differences
  bool is_least_ = false;
  double least_sum_ = 0.0;
  LawModuli at_best_;
  std::vector<LawModuli> moduli_beside_;  // of an amount more of each unknown
};

}  // namespace pfdm
