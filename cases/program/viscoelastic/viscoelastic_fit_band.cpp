#include "cases/program/viscoelastic/viscoelastic_fit_band.h"

#include "physics/materials/prony_response.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

constexpr double points_per_decade = 10.0;
constexpr double step = 1e-5;  // of the differences, relative

/// Storage and loss modulus in tension, then in shear [Pa]; the loss is 0 without branches.
using Moduli = std::array<double, 4>;

Moduli moduli_at(const PronyLaw& law, double angular_frequency) {
  const auto in_tension = complex_modulus(young_modulus(law), angular_frequency),
             in_shear = complex_modulus(shear_modulus(law), angular_frequency);
  return {in_tension.real(), in_tension.imag(), in_shear.real(), in_shear.imag()};
}

std::vector<double> frequencies_in(const TimeWindow& window) {
  const double lowest = 1.0 / (2.0 * std::numbers::pi * window.longest),
               decades = std::log10(window.longest / window.shortest);
  const auto n = static_cast<int>(std::ceil(points_per_decade * decades));
  std::vector<double> frequencies{lowest};
  for (int i = 1; i <= n; ++i) frequencies.push_back(lowest * std::pow(10.0, decades * i / n));
  return frequencies;
}

/// An estimate, and how far its interval reaches: its logarithm on a logarithmic scale.
struct Reach {
  double value = 0.0, by = 0.0;
  bool is_log = false;
  double moved(double sign) const { return is_log ? value * std::exp(sign * step) : value * (1.0 + sign * step); }
  double distance() const { return 2.0 * step * (is_log ? 1.0 : value); }
};

/// Nothing where an interval is not known.
std::optional<std::vector<Reach>> reaches_of(const FitFindings& findings) {
  std::vector<Reach> reaches;
  if (!is_sound(findings.verdict) || findings.correlation.rows() != std::ssize(findings.parameters))
    return std::nullopt;
  for (const FittedParameter& p : findings.parameters) {
    Reach reach{.value = p.estimate, .is_log = p.log_scale};
    reach.by = 0.5 * (p.log_scale ? std::log(p.upper / p.lower) : p.upper - p.lower);
    if (!std::isfinite(reach.by)) return std::nullopt;
    reaches.push_back(reach);
  }
  return reaches;
}

/// Half the widths of the intervals of the logarithms; 0 of a modulus that is 0.
Moduli widths_at(const ViscoelasticFit& fit, const std::vector<Reach>& reaches, const Eigen::MatrixXd& correlation,
                 double angular_frequency) {
  Eigen::MatrixXd effects(4, std::ssize(reaches));
  std::vector<double> values;
  values.reserve(reaches.size());
  for (const Reach& reach : reaches) values.push_back(reach.value);
  for (std::size_t j = 0; j < reaches.size(); ++j) {
    const auto beside = [&](double sign) {
      std::vector<double> there = values;
      there[j] = reaches[j].moved(sign);
      return moduli_at(with_values(fit.law, fit.choice, there).value_or(fit.law), angular_frequency);
    };
    const Moduli above = beside(1.0), below = beside(-1.0);
    for (std::size_t m = 0; m < above.size(); ++m)
      effects(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(j)) =
          above[m] > 0.0 && below[m] > 0.0 ? std::log(above[m] / below[m]) / reaches[j].distance() * reaches[j].by
                                           : 0.0;
  }
  const Eigen::VectorXd squares = (effects * correlation).cwiseProduct(effects).rowwise().sum();
  Moduli widths{};
  for (std::size_t m = 0; m < widths.size(); ++m)
    widths[m] = std::sqrt(std::max(squares[static_cast<Eigen::Index>(m)], 0.0));
  return widths;
}

}  // namespace

CsvTable modulus_band(const ViscoelasticFit& fit, const FitFindings& findings, const TimeWindow& window) {
  constexpr std::array names{"young_storage_modulus", "young_loss_modulus", "shear_storage_modulus",
                             "shear_loss_modulus"};
  const std::vector<double> frequencies = frequencies_in(window);
  const auto reaches = reaches_of(findings);
  std::array<std::vector<double>, 4> estimate, lower, upper;
  for (const double f : frequencies) {
    const double w = 2.0 * std::numbers::pi * f;
    const Moduli at = moduli_at(fit.law, w);
    const Moduli widths = reaches ? widths_at(fit, *reaches, findings.correlation, w) : Moduli{};
    for (std::size_t m = 0; m < at.size(); ++m) {
      estimate[m].push_back(at[m]);
      lower[m].push_back(at[m] * std::exp(-widths[m]));
      upper[m].push_back(at[m] * std::exp(widths[m]));
    }
  }
  CsvTable table;
  table.comments.emplace_back("complex moduli of the fitted law in the window of the data");
  table.comments.emplace_back(reaches ? "lower, upper: 95 % intervals, to first order in the estimates"
                                      : "without intervals, which would not hold: see the verdict in fit.json");
  table.add("frequency_Hz", frequencies);
  for (std::size_t m = 0; m < names.size(); ++m) {
    table.add(fmt::format("{}_Pa", names[m]), std::move(estimate[m]));
    if (!reaches) continue;
    table.add(fmt::format("lower_{}_Pa", names[m]), std::move(lower[m]));
    table.add(fmt::format("upper_{}_Pa", names[m]), std::move(upper[m]));
  }
  return table;
}

}  // namespace pfdm
