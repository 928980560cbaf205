#include "solver/point/viscoelastic_start.h"

#include "solver/linear/dense_algebra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr int fine_per_decade = 6;   // of the fine grid
constexpr double small_part = 0.02;  // of all moduli: a branch that is added

/// Rows of the linear problem in the moduli.
class LinearProblem {
 public:
  LinearProblem(const PronyLaw& law, bool holds_relaxed, std::span<const double> deviations,
                std::span<const double> times)
      : law_(law), holds_relaxed_(holds_relaxed), deviations_(deviations), units_{{.relaxed = 1.0}} {
    for (const double time : times) units_.push_back({.relaxed = 0.0, .branches = {{1.0, time}}});
  }

  void add(const ViscoelasticExperiment& experiment) {
    const double tension = 2.0 * (1.0 + law_.relaxed.poisson_ratio());
    factor_ = experiment.deformation == Deformation::tension ? tension : 1.0;
    for (const ViscoelasticExperiment::Channel& channel : experiment.channels) {
      if (!experiment.is_frequency_sweep())
        add_history(experiment, channel);
      else
        for (std::size_t i = 0; i < channel.values.size(); ++i) add_frequency(experiment, channel, i);
      done_ += channel.values.size();
    }
  }

  /// Of the relaxed modulus, which may be the law's, and of each branch.
  Eigen::VectorXd solve() const {
    const auto n = std::ssize(right_), k = std::ssize(units_);
    Eigen::MatrixXd A(n, k);
    for (Eigen::Index i = 0; i < n; ++i) A.row(i) = rows_[static_cast<std::size_t>(i)].transpose();
    Eigen::VectorXd right = Eigen::VectorXd::Map(right_.data(), n);
    if (holds_relaxed_) {
      right -= law_.relaxed.mu * A.col(0);
      A.col(0).setZero();
    }
    Eigen::VectorXd moduli = non_negative(A, right);
    if (holds_relaxed_) moduli[0] = law_.relaxed.mu;
    return moduli;
  }

 private:
  static Eigen::VectorXd non_negative(const Eigen::MatrixXd& A, const Eigen::VectorXd& right) {
    const Eigen::Index k = A.cols();
    if (A.rows() <= k) return non_negative_least_squares(A, right);
    // The same in as many rows as columns: of many rows the rest of the work is small.
    Eigen::MatrixXd both(A.rows(), k + 1);
    both << A, right;
    const Eigen::MatrixXd R = upper_triangle(both);
    return non_negative_least_squares(R.leftCols(k), R.col(k));
  }

  /// Stresses by strains, whichever was followed.
  void add_history(const ViscoelasticExperiment& experiment, const ViscoelasticExperiment::Channel& channel) {
    const LoadPath strains = whole_path(experiment, experiment.follows_stress ? channel.values : experiment.followed);
    const std::vector<double>& stresses = experiment.follows_stress ? experiment.followed : channel.values;
    const double stiffness = experiment.follows_stress ? rms_of(stresses) / rms_of(channel.values) : 1.0;
    std::vector<std::vector<double>> columns;
    for (const RelaxationModulus& unit : units_)
      columns.push_back(stress_response(unit, strains.times, strains.followed));
    for (std::size_t i = 0; i < stresses.size(); ++i) {
      Eigen::VectorXd row(std::ssize(units_));
      for (std::size_t j = 0; j < units_.size(); ++j) row[static_cast<Eigen::Index>(j)] = columns[j][strains.added + i];
      add_row(row, stresses[i], stiffness * deviations_[done_ + i]);
    }
  }

  /// Of a loss factor: loss less the factor times storage is zero.
  void add_frequency(const ViscoelasticExperiment& experiment, const ViscoelasticExperiment::Channel& channel,
                     std::size_t i) {
    const double value = channel.values[i];
    const bool is_factor = channel.quantity == MeasuredQuantity::loss_factor;
    Eigen::VectorXd row(std::ssize(units_));
    for (std::size_t j = 0; j < units_.size(); ++j) {
      const auto M = complex_modulus(units_[j], experiment.angular_frequencies[i]);
      row[static_cast<Eigen::Index>(j)] = is_factor ? M.imag() - value * M.real()
                                          : channel.quantity == MeasuredQuantity::loss_modulus ? M.imag()
                                                                                               : M.real();
    }
    const double scale = is_factor ? storage_at(experiment, i) : 1.0;
    add_row(row, is_factor ? 0.0 : value, scale * deviations_[done_ + i]);
  }

  /// Measured or, of loss factors alone, as large as the law's moduli.
  double storage_at(const ViscoelasticExperiment& experiment, std::size_t i) const {
    for (const ViscoelasticExperiment::Channel& channel : experiment.channels)
      if (channel.quantity == MeasuredQuantity::storage_modulus) return channel.values[i];
    return factor_ * shear_modulus(law_).instantaneous();
  }

  void add_row(const Eigen::VectorXd& row, double right, double deviation) {
    rows_.emplace_back(factor_ / deviation * row);
    right_.push_back(right / deviation);
  }

  const PronyLaw& law_;
  bool holds_relaxed_;
  std::span<const double> deviations_;
  std::vector<RelaxationModulus> units_;
  std::vector<Eigen::VectorXd> rows_;
  std::vector<double> right_;
  std::size_t done_ = 0;  // values before
  double factor_ = 1.0;   // modulus of the test over the shear modulus
};

PronyBranch joined(const PronyBranch& a, const PronyBranch& b) {
  const double sum = a.modulus + b.modulus;
  return {sum, std::exp((a.modulus * std::log(a.time) + b.modulus * std::log(b.time)) / sum)};
}

/// Joins branches nearer to each other than a factor, the nearest first, until at most `most` are left.
void join_near(std::vector<PronyBranch>& branches, double factor, std::size_t most) {
  while (branches.size() > 1) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i + 1 < branches.size(); ++i)
      if (branches[i + 1].time / branches[i].time < branches[nearest + 1].time / branches[nearest].time) nearest = i;
    const bool is_near = branches[nearest + 1].time / branches[nearest].time < factor;
    if (!is_near && branches.size() <= most) return;
    branches[nearest] = joined(branches[nearest], branches[nearest + 1]);
    branches.erase(branches.begin() + nearest + 1);
  }
}

/// With the branches of a fine grid of times.
PronyLaw law_of_fine_times(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                           std::span<const double> deviations) {
  const TimeWindow window = time_window(at_reference(experiments, law.shift));
  const double decades = std::log10(window.longest / window.shortest);
  const int points = std::clamp(static_cast<int>(std::ceil(fine_per_decade * decades)) + 1, 2, 80);
  return law_of_times(law, holds_relaxed, experiments, deviations, spread_times(window, points));
}

}  // namespace

std::vector<double> spread_times(const TimeWindow& window, int n) {
  std::vector<double> times;
  const double decades = std::log(window.longest / window.shortest);
  for (int i = 0; i < n; ++i)
    times.push_back(window.shortest * std::exp(decades * (n == 1 ? 0.5 : static_cast<double>(i) / (n - 1))));
  return times;
}

PronyLaw law_of_times(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                      std::span<const double> deviations, std::span<const double> times) {
  LinearProblem problem(law, holds_relaxed, deviations, times);
  for (const ViscoelasticExperiment& experiment : experiments) problem.add(at_reference(experiment, law.shift));
  const Eigen::VectorXd moduli = problem.solve();
  const double sum = moduli.sum();
  if (!(sum > 0.0)) {  // loss factors alone
    PronyLaw even = law;
    even.shear.clear();
    for (const double time : times) even.shear.push_back({law.relaxed.mu, time});
    return even;
  }
  PronyLaw result = law;
  const double mu = std::max(moduli[0], 1e-3 * sum), nu = law.relaxed.poisson_ratio();
  if (!holds_relaxed) result.relaxed = from_young_poisson(2.0 * (1.0 + nu) * mu, nu);
  result.shear.clear();
  for (Eigen::Index i = 1; i < moduli.size(); ++i)
    if (moduli[i] > 1e-9 * sum) result.shear.push_back({moduli[i], times[static_cast<std::size_t>(i) - 1]});
  return result;
}

PronyLaw law_of_shift(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                      std::span<const double> deviations) {
  using Factors = std::array<double, 2>;  // logarithms, of C1 or the activation energy, and of C2
  constexpr double coarse = 0.5, fine = 0.01;
  constexpr std::array steps{-1.0, 0.0, 1.0};
  const auto with = [&](const Factors& factors) {
    PronyLaw other = law;
    other.shift->c1 *= std::exp(factors[0]);
    other.shift->activation_energy *= std::exp(factors[0]);
    other.shift->c2 *= std::exp(factors[1]);
    return other;
  };
  Factors best{0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  const auto improves = [&](const Factors& factors) {
    const PronyLaw spectrum = law_of_fine_times(with(factors), holds_relaxed, experiments, deviations);
    const double misfit = rms_of(fit_residuals(spectrum, experiments, deviations));
    if (!(misfit < least)) return false;
    best = factors;
    least = misfit;
    return true;
  };
  const bool has_second = law.shift->law == TemperatureShift::Law::wlf;
  for (int i = -2; i <= 2; ++i)
    for (int j = has_second ? -2 : 0; j <= (has_second ? 2 : 0); ++j) improves({coarse * i, coarse * j});
  for (double step = 0.5 * coarse; step > fine;) {
    const Factors centre = best;
    bool is_better = false;
    for (const double i : steps)
      for (const double j : steps)
        if ((i != 0.0 || j != 0.0) && (has_second || j == 0.0))
          is_better |= improves({centre[0] + step * i, centre[1] + step * j});
    if (!is_better) step *= 0.5;
  }
  return with(best);
}

PronyLaw law_of_branches(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                         std::span<const double> deviations, int n) {
  const TimeWindow window = time_window(at_reference(experiments, law.shift));
  PronyLaw result = law_of_fine_times(law, holds_relaxed, experiments, deviations);
  join_near(result.shear, std::pow(10.0, 1.5 / fine_per_decade), static_cast<std::size_t>(n));
  while (std::ssize(result.shear) < n) result = with_one_more(result, window);
  return result;
}

std::vector<PronyLaw> with_one_less(const PronyLaw& law) {
  PronyLaw joined = law, left_out = law;
  join_near(joined.shear, 1.0, law.shear.size() - 1);
  left_out.shear.erase(std::ranges::min_element(left_out.shear, {}, &PronyBranch::modulus));
  return {joined, left_out};
}

PronyLaw with_one_more(const PronyLaw& law, const TimeWindow& window) {
  std::vector<double> places{window.shortest};
  for (const PronyBranch& branch : law.shear)
    places.push_back(std::clamp(branch.time, window.shortest, window.longest));
  places.push_back(window.longest);
  std::ranges::sort(places);
  std::size_t widest = 0;
  for (std::size_t i = 1; i + 1 < places.size(); ++i)
    if (places[i + 1] / places[i] > places[widest + 1] / places[widest]) widest = i;
  PronyLaw result = law;
  result.shear.push_back(
      {small_part * shear_modulus(law).instantaneous(), std::sqrt(places[widest] * places[widest + 1])});
  std::ranges::sort(result.shear, {}, &PronyBranch::time);
  return result;
}

}  // namespace pfdm
