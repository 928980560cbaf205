#include "solver/point/endochronic_transient.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

double phi1(double x) { return x > 0.0 ? -std::expm1(-x) / x : 1.0; }

/// Component of the strain that condition k follows, -1 if it is one of stress.
int followed_strain(const LoadSegment::Condition& condition) {
  if (!condition.condition.on_stress.isZero()) return -1;
  Eigen::Index k = 0;
  condition.condition.on_strain.cwiseAbs().maxCoeff(&k);
  return static_cast<int>(k);
}

Mandel elastic_strain(const IsotropicElasticity& c, const Mandel& stress) {
  return deviator(stress) / (2.0 * c.mu) + (trace(stress) / (9.0 * c.bulk_modulus())) * mandel_identity();
}

void complete_by_incompressibility(Mandel& plastic, const std::array<bool, 6>& known) {
  double sum = 0.0;
  int unknown = 0;
  for (int k = 0; k < 3; ++k) known[k] ? sum += plastic[k] : ++unknown;
  for (int k = 0; k < 3; ++k)
    if (!known[k]) plastic[k] = -sum / unknown;
}

/// Stresses of the terms after an increment of plastic strain during dz.
void advance(const Kernel& kernel, std::vector<Mandel>& s, const Mandel& de_p, double dz) {
  for (std::size_t r = 0; r < kernel.size(); ++r)
    s[r] = std::exp(-kernel[r].alpha * dz) * s[r] + (2.0 * kernel[r].C * phi1(kernel[r].alpha * dz)) * de_p;
}

/// An increment of the response: ds . de_p = 2 g |de_p|^2 - sum s_r . de_p (1 - exp(-alpha_r dz)), an equation for f.
struct Increment {
  const Kernel& kernel;
  const std::vector<Mandel>& s;
  Mandel ds, de_p;
  double dzeta;

  double misfit(double f) const {
    double sum = -ds.dot(de_p);
    for (std::size_t r = 0; r < kernel.size(); ++r) {
      const double x = kernel[r].alpha * dzeta / f;
      sum += 2.0 * kernel[r].C * phi1(x) * dzeta * dzeta + s[r].dot(de_p) * std::expm1(-x);
    }
    return sum;
  }

  double root_between(double low, double high) const {
    const bool rises = misfit(low) < 0.0;
    while (high - low > 1e-14 * high) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      ((misfit(middle) < 0.0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// The root nearest to `from`, searched outwards in steps of 2 %.
  std::optional<double> root_near(double from) const {
    constexpr double factor = 1.02;
    double low = from, high = from, at_low = misfit(from), at_high = at_low;
    if (at_low == 0.0) return from;
    for (int i = 0; i < 150; ++i) {
      const double next_high = high * factor, next_low = low / factor;
      const double at_next_high = misfit(next_high), at_next_low = misfit(next_low);
      const bool above = at_high * at_next_high <= 0.0, below = at_low * at_next_low <= 0.0;
      if (above || below) return above ? root_between(high, next_high) : root_between(next_low, low);
      high = next_high, low = next_low, at_high = at_next_high, at_low = at_next_low;
    }
    return std::nullopt;
  }

  double weight(double f) const {
    constexpr double h = 1e-4;
    return std::abs(misfit(f * (1.0 + h)) - misfit(f * (1.0 - h))) / (2.0 * h * dzeta);
  }
};

/// A column for every alpha: what C = 1 contributes to the measured stresses, experiment by experiment.
Eigen::MatrixXd unit_responses(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                               const std::vector<double>& alphas, Eigen::VectorXd& measured) {
  std::vector<double> rows, data;
  for (const MaterialExperiment& experiment : experiments) {
    if (experiment.follows_stress) continue;
    const PlasticHistory history = plastic_history(law.elasticity, experiment);
    Kernel units;
    for (const double alpha : alphas) units.push_back({1.0, alpha});
    std::vector<Mandel> s(units.size(), Mandel::Zero());
    double zeta = 0.0;
    for (std::size_t i = 1; i < history.s.size(); ++i) {
      const Mandel de_p = history.plastic_strain[i] - history.plastic_strain[i - 1];
      const double dzeta = de_p.norm(), dt = history.time[i] - history.time[i - 1];
      advance(units, s, de_p, dzeta / law.hardening(zeta + 0.5 * dzeta, dzeta / dt).f);
      zeta += dzeta;
      for (const MaterialExperiment::Channel& channel : experiment.channels) {
        for (const Mandel& unit : s) rows.push_back(unit[channel.component]);
        data.push_back(history.s[i][channel.component]);
      }
    }
  }
  measured = Eigen::Map<Eigen::VectorXd>(data.data(), static_cast<Eigen::Index>(data.size()));
  return Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      rows.data(), measured.size(), static_cast<Eigen::Index>(alphas.size()));
}

/// From what the largest plastic strain can tell to what the increments can.
std::vector<double> alpha_grid(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments) {
  double largest = 0.0, path = 0.0, n = 0.0;
  for (const MaterialExperiment& experiment : experiments) {
    if (experiment.follows_stress) continue;
    const PlasticHistory history = plastic_history(law.elasticity, experiment);
    for (std::size_t i = 1; i < history.s.size(); ++i, n += 1.0) {
      largest = std::max(largest, history.plastic_strain[i].norm());
      path += (history.plastic_strain[i] - history.plastic_strain[i - 1]).norm();
    }
  }
  const double low = 0.1 / largest, high = 3.0 * n / path;
  std::vector<double> grid;
  constexpr int n_grid = 30;
  grid.reserve(n_grid);
  for (int i = 0; i < n_grid; ++i) grid.push_back(low * std::pow(high / low, i / (n_grid - 1.0)));
  return grid;
}

KernelTerm merged(const KernelTerm& a, const KernelTerm& b) {
  const double C = a.C + b.C;
  return {C, std::exp((a.C * std::log(a.alpha) + b.C * std::log(b.alpha)) / C)};
}

/// Merges the nearest neighbours, or splits the largest term, until there are n.
Kernel gathered(Kernel kernel, std::size_t n) {
  while (kernel.size() > n) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i + 1 < kernel.size(); ++i)
      if (kernel[i + 1].alpha / kernel[i].alpha < kernel[nearest + 1].alpha / kernel[nearest].alpha) nearest = i;
    kernel[nearest] = merged(kernel[nearest], kernel[nearest + 1]);
    kernel.erase(kernel.begin() + nearest + 1);
  }
  while (kernel.size() < n) {
    const auto largest = std::ranges::max_element(kernel, {}, &KernelTerm::C);
    const KernelTerm half{0.5 * largest->C, 2.0 * largest->alpha};
    *largest = {half.C, 0.5 * largest->alpha};
    kernel.insert(largest + 1, half);
  }
  return kernel;
}

}  // namespace

PlasticHistory plastic_history(const IsotropicElasticity& elasticity, const MaterialExperiment& experiment) {
  PlasticHistory history{.time = experiment.loading.times, .s = {}, .plastic_strain = {}};
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    Mandel stress = Mandel::Zero();
    for (const MaterialExperiment::Channel& channel : experiment.channels)
      stress[channel.component] = mandel_factor(channel.component) * channel.values[i];
    const Mandel elastic = elastic_strain(elasticity, stress);
    Mandel plastic = Mandel::Zero();
    std::array<bool, 6> known{};
    for (const LoadSegment::Condition& condition : experiment.loading.conditions) {
      const int k = followed_strain(condition);
      if (k < 0) continue;
      known[k] = true;
      plastic[k] = condition.values[i] / condition.condition.on_strain[k] - elastic[k];
    }
    complete_by_incompressibility(plastic, known);
    history.s.push_back(deviator(stress));
    history.plastic_strain.push_back(plastic);
  }
  return history;
}

std::vector<HardeningPoint> transient_hardening(const EndochronicLaw& law, const MaterialExperiment& experiment) {
  const PlasticHistory history = plastic_history(law.elasticity, experiment);
  std::vector<Mandel> s(law.kernel.size(), Mandel::Zero());
  std::vector<HardeningPoint> points;
  double zeta = 0.0, f = law.hardening(0.0, 0.0).f;
  for (std::size_t i = 1; i < history.s.size(); ++i) {
    const Mandel de_p = history.plastic_strain[i] - history.plastic_strain[i - 1];
    const double dzeta = de_p.norm(), dt = history.time[i] - history.time[i - 1];
    if (dzeta == 0.0) continue;
    const Increment increment{law.kernel, s, history.s[i] - history.s[i - 1], de_p, dzeta};
    if (const auto root = increment.root_near(f)) {
      f = *root;
      points.push_back({zeta + 0.5 * dzeta, dzeta / dt, f, increment.weight(f)});
    }
    advance(law.kernel, s, de_p, dzeta / f);
    zeta += dzeta;
  }
  return points;
}

Kernel first_kernel(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments, int n_terms) {
  const std::vector<double> grid = alpha_grid(law, experiments);
  Eigen::VectorXd measured;
  const Eigen::MatrixXd A = unit_responses(law, experiments, grid, measured);
  const Eigen::VectorXd C = non_negative_least_squares(A, measured);
  Kernel kernel;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (C[i] > 1e-6 * C.maxCoeff()) kernel.push_back({C[i], grid[i]});
  if (kernel.empty()) kernel.push_back({law.elasticity.mu, grid[grid.size() / 2]});
  return gathered(std::move(kernel), static_cast<std::size_t>(n_terms));
}

}  // namespace pfdm
