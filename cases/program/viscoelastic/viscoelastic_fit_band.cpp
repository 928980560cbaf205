#include "cases/program/viscoelastic/viscoelastic_fit_band.h"

#include "physics/materials/prony_response.h"
#include "solver/point/allowed_spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

constexpr double points_per_decade = 10.0;
constexpr double step = 1e-5;           // of the differences, relative
constexpr double least_outside = 0.01;  // of half the width of an interval: the search for its ends

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

double half_width(const FittedParameter& p) {
  return 0.5 * (p.log_scale ? std::log(p.upper / p.lower) : p.upper - p.lower);
}

/// Nothing where an interval is not known.
std::optional<std::vector<Reach>> reaches_of(const FitFindings& findings) {
  std::vector<Reach> reaches;
  if (!is_sound(findings.verdict) || findings.correlation.rows() != std::ssize(findings.parameters))
    return std::nullopt;
  for (const FittedParameter& p : findings.parameters) {
    Reach reach{.value = p.estimate, .is_log = p.log_scale};
    reach.by = half_width(p);
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

/// Ends of the four moduli.
struct Ends {
  Moduli lower{}, upper{};
};

Ends to_first_order(const ViscoelasticFit& fit, const std::vector<Reach>& reaches, const Eigen::MatrixXd& correlation,
                    double angular_frequency) {
  const Moduli at = moduli_at(fit.law, angular_frequency),
               widths = widths_at(fit, reaches, correlation, angular_frequency);
  Ends ends;
  for (std::size_t m = 0; m < at.size(); ++m) {
    ends.lower[m] = at[m] * std::exp(-widths[m]);
    ends.upper[m] = at[m] * std::exp(widths[m]);
  }
  return ends;
}

Ends of_allowed(const AllowedSpectra& spectra, double allowance, double angular_frequency) {
  Ends ends;
  for (std::size_t m = 0; m < ends.lower.size(); ++m) {
    const auto figure = [&, m](const LawModuli& moduli) {
      const auto value = complex_modulus(m < 2 ? moduli.young : moduli.shear, angular_frequency);
      return m % 2 == 0 ? value.real() : value.imag();
    };
    const auto lowest = spectra.lowest(figure, allowance), highest = spectra.highest(figure, allowance);
    ends.lower[m] = std::max(lowest ? lowest->value : 0.0, 0.0);
    ends.upper[m] = highest ? highest->value : std::numeric_limits<double>::infinity();
  }
  return ends;
}

/// By how much a sum of squares may be above the least: for what the interval of an estimate spans, which holds
/// Student's t and what correlated residuals widen; 1.96^2 where the noise is known. Zero of a fit without intervals.
double allowance_of(const ViscoelasticFit& fit, const FitFindings& findings) {
  double largest = 0.0;
  if (!is_sound(findings.verdict) || !fit.choice.moduli) return largest;
  for (std::size_t j = 0; j < findings.parameters.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const double half = half_width(findings.parameters[j]), variance = fit.result.inverse_normal(i, i);
    if (std::isfinite(half) && variance > 0.0) largest = std::max(largest, half * half / variance);
  }
  return constrained_allowance * largest;
}

/// How many moduli lie outside of their ends, and by how much of half the width at most.
struct Outside {
  std::size_t n = 0;
  double most = 0.0;
  void add(const Moduli& at, const Ends& ends) {
    for (std::size_t m = 0; m < at.size(); ++m) {
      const double half = std::isfinite(ends.upper[m]) ? 0.5 * (ends.upper[m] - ends.lower[m]) : ends.lower[m],
                   by = std::max(ends.lower[m] - at[m], at[m] - ends.upper[m]);
      if (!(by > least_outside * half)) continue;
      ++n;
      most = std::max(most, by / half);
    }
  }
};

std::string warning_of(const Outside& outside, std::size_t n_moduli, std::size_t n_branches) {
  if (outside.n == 0) return "";
  return fmt::format(
      "{} of {} moduli over frequency lie outside of their intervals, by up to {:.2g} of half the width: other spectra "
      "than {} branch{} meet the data better; more of them would lie inside (branches, and times = \"fixed\", in "
      "[fit])",
      outside.n, n_moduli, outside.most, n_branches, n_branches == 1 ? "" : "es");
}

std::string comment_of(bool is_known, bool is_allowed) {
  if (!is_known) return "without intervals, which would not hold: see the verdict in fit.json";
  return is_allowed ? "lower, upper: 95 % intervals, of all spectra that the data allow"
                    : "lower, upper: 95 % intervals, to first order in the estimates";
}

/// Moduli over frequency, and the ends of their intervals.
struct BandColumns {
  std::array<std::vector<double>, 4> estimate, lower, upper;

  void add(const Moduli& at, const Ends& ends) {
    for (std::size_t m = 0; m < at.size(); ++m) {
      estimate[m].push_back(at[m]);
      lower[m].push_back(ends.lower[m]);
      upper[m].push_back(ends.upper[m]);
    }
  }

  void put_into(CsvTable& table, bool with_intervals) {
    constexpr std::array names{"young_storage_modulus", "young_loss_modulus", "shear_storage_modulus",
                               "shear_loss_modulus"};
    for (std::size_t m = 0; m < names.size(); ++m) {
      table.add(fmt::format("{}_Pa", names[m]), std::move(estimate[m]));
      if (!with_intervals) continue;
      table.add(fmt::format("lower_{}_Pa", names[m]), std::move(lower[m]));
      table.add(fmt::format("upper_{}_Pa", names[m]), std::move(upper[m]));
    }
  }
};

}  // namespace

ModulusBand modulus_band(const ViscoelasticFit& fit, const FitFindings& findings,
                         const ViscoelasticExperiments& experiments, std::span<const double> deviations) {
  const std::vector<double> frequencies = frequencies_in(time_window(experiments));
  const double allowance = allowance_of(fit, findings);
  std::optional<AllowedSpectra> spectra;
  if (allowance > 0.0) spectra.emplace(fit, experiments, deviations);
  const bool is_lost = spectra && !spectra->is_least();
  if (is_lost) spectra.reset();
  const auto reaches = spectra || is_lost ? std::nullopt : reaches_of(findings);
  BandColumns columns;
  Outside outside;
  for (const double f : frequencies) {
    const double w = 2.0 * std::numbers::pi * f;
    const Moduli at = moduli_at(fit.law, w);
    Ends ends;
    if (spectra) {
      ends = of_allowed(*spectra, allowance, w);
      outside.add(at, ends);
    } else if (reaches) {
      ends = to_first_order(fit, *reaches, findings.correlation, w);
    }
    columns.add(at, ends);
  }
  ModulusBand band;
  band.warning =
      is_lost ? "no spectrum that meets the data best was found: moduli over frequency have no intervals, and that "
                "of young_modulus is too narrow where times lie beyond the data; more branches may help "
                "(branches, and times = \"fixed\", in [fit])"
              : warning_of(outside, 4 * frequencies.size(), fit.law.shear.size());
  band.table.comments.emplace_back("complex moduli of the fitted law in the window of the data");
  band.table.comments.push_back(comment_of(spectra || reaches, spectra.has_value()));
  band.table.add("frequency_Hz", frequencies);
  columns.put_into(band.table, spectra || reaches);
  return band;
}

void widen_relaxed_modulus(const ViscoelasticFit& fit, const ViscoelasticExperiments& experiments,
                           std::span<const double> deviations, FitFindings& findings) {
  const double allowance = allowance_of(fit, findings);
  const auto at = std::ranges::find(findings.parameters, "young_modulus", &FittedParameter::name);
  if (!(allowance > 0.0) || at == findings.parameters.end()) return;
  const AllowedSpectra spectra(fit, experiments, deviations, {.slower = 1.0});
  if (!spectra.is_least()) return;
  const auto figure = [](const LawModuli& moduli) { return moduli.young.relaxed; };
  const auto lowest = spectra.lowest(figure, allowance), highest = spectra.highest(figure, allowance);
  at->lower = std::min(at->lower, std::max(lowest ? lowest->value : 0.0, at->lower_bound));
  at->upper = std::max(at->upper, std::min(highest ? highest->value : at->upper_bound, at->upper_bound));
}

}  // namespace pfdm
