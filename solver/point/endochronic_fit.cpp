#include "solver/point/endochronic_fit.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

constexpr double reach = 1e5;  // of a parameter over its first guess, where nothing else bounds it

/// Of differences where what is held comes to rest: the equations of those steps are nearly singular, and rounding
/// leaves some 1e-9 of the stress.
constexpr double step_with_rate = 1e-5;

FitParameter positive(std::string name, std::string_view unit, double first) {
  return {.name = std::move(name),
          .unit = std::string(unit),
          .first = first,
          .lower = first / reach,
          .upper = first * reach,
          .log_scale = true};
}

/// f_1_2 ...: at the first rate and the second zeta ...; f_1_1 fixes the scale of the intrinsic time.
template <class FactorType, class Visit>
void visit_rate_table(FactorType& factor, const Visit& visit) {
  const RateTable table = rate_table(factor.p);
  const std::size_t first = factor.p.size() - table.f.size();
  for (std::size_t i = 0; i < table.rate.size(); ++i)
    for (std::size_t j = 0; j < table.zeta.size(); ++j)
      if (i + j > 0) visit(fmt::format("f_{}_{}", i + 1, j + 1), "1", factor.p[first + table.at(i, j)]);
}

/// Calls visit(name, unit, value) for every chosen parameter of a factor.
template <class FactorType, class Visit>
void visit_factor(FactorType& factor, const Visit& visit) {
  if (factor.law->of_path_and_rate != nullptr) return visit_rate_table(factor, visit);
  if (factor.law->tabulated) {
    const std::size_t n = factor.p.size() / 2;
    for (std::size_t i = 1; i < n; ++i) visit(fmt::format("f_{}", i + 1), "1", factor.p[n + i]);
    return;
  }
  for (std::size_t i = 0; i < factor.p.size(); ++i) {
    const LawParameter& info = factor.law->parameters[i];
    if (info.name != "f_0" && info.name != "reference_rate") visit(std::string(info.name), info.unit, factor.p[i]);
  }
}

/// Calls visit for every chosen parameter of the law, which it may change.
template <class Law, class Visit>
void visit_parameters(Law& law, const FitChoice& choice, const Visit& visit) {
  if (choice.kernel)
    for (std::size_t r = 0; r < law.kernel.size(); ++r) {
      visit(fmt::format("C_{}", r + 1), "Pa", law.kernel[r].C);
      if (law.kernel[r].alpha > 0.0) visit(fmt::format("alpha_{}", r + 1), "1", law.kernel[r].alpha);
    }
  if (choice.hardening) visit_factor(law.hardening.with_path, visit);
  if (choice.rate) visit_factor(law.hardening.with_rate, visit);
}

void sort_kernel(EndochronicLaw& law) {
  std::ranges::sort(law.kernel, [](const KernelTerm& a, const KernelTerm& b) { return a.alpha > b.alpha; });
}

}  // namespace

std::vector<FitParameter> fit_parameters(const EndochronicLaw& law, const FitChoice& choice) {
  std::vector<FitParameter> parameters;
  visit_parameters(law, choice, [&](std::string name, std::string_view unit, double value) {
    if (!(value > 0.0)) throw InputError(fmt::format("parameter {}: the first guess {} must be positive", name, value));
    parameters.push_back(positive(std::move(name), unit, value));
  });
  if (choice.young_modulus) parameters.push_back(positive("young_modulus", "Pa", law.elasticity.young_modulus()));
  return parameters;
}

std::optional<EndochronicLaw> with_values(const EndochronicLaw& law, const FitChoice& choice,
                                          std::span<const double> values) {
  for (const double value : values)
    if (!(value > 0.0) || !std::isfinite(value)) return std::nullopt;
  EndochronicLaw result = law;
  std::size_t i = 0;
  visit_parameters(result, choice, [&](const std::string&, std::string_view, double& value) { value = values[i++]; });
  if (choice.young_modulus) result.elasticity = from_young_poisson(values[i], law.elasticity.poisson_ratio());
  return result;
}

std::optional<std::vector<std::vector<double>>> respond(const EndochronicLaw& law, const MaterialExperiment& experiment,
                                                        const ControlSettings& settings) {
  const HistoryResult history = run_history(law, {experiment.loading}, settings);
  if (!history.converged) return std::nullopt;
  std::vector<std::vector<double>> answers;
  for (const MaterialExperiment::Channel& channel : experiment.channels) {
    answers.emplace_back();
    for (const HistoryPoint& point : history.points) {
      const Mandel& measured = experiment.follows_stress ? point.state.strain : point.stress;
      answers.back().push_back(measured[channel.component] / mandel_factor(channel.component));
    }
  }
  return answers;
}

bool noise_is_known(const std::vector<MaterialExperiment>& experiments) {
  return std::ranges::all_of(experiments, [](const MaterialExperiment& experiment) {
    return std::ranges::all_of(experiment.channels, [](const auto& channel) { return channel.noise > 0.0; });
  });
}

std::size_t n_measured(const std::vector<MaterialExperiment>& experiments) {
  std::size_t n = 0;
  for (const MaterialExperiment& experiment : experiments)
    for (const MaterialExperiment::Channel& channel : experiment.channels) n += channel.values.size();
  return n;
}

double rms_measured(const std::vector<MaterialExperiment>& experiments, bool strains) {
  double sum = 0.0, n = 0.0;
  for (const MaterialExperiment& experiment : experiments) {
    if (experiment.follows_stress != strains) continue;
    for (const MaterialExperiment::Channel& channel : experiment.channels) {
      for (const double value : channel.values) sum += value * value;
      n += static_cast<double>(channel.values.size());
    }
  }
  return std::sqrt(sum / n);
}

std::optional<std::vector<double>> fit_residuals(const EndochronicLaw& law,
                                                 const std::vector<MaterialExperiment>& experiments,
                                                 const ControlSettings& settings) {
  const bool known = noise_is_known(experiments);
  const double of_stress = rms_measured(experiments), of_strain = rms_measured(experiments, true);
  std::vector<double> residuals;
  for (const MaterialExperiment& experiment : experiments) {
    const auto model = respond(law, experiment, settings);
    if (!model) return std::nullopt;
    const double scale = experiment.follows_stress ? of_strain : of_stress;
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      const MaterialExperiment::Channel& channel = experiment.channels[c];
      for (std::size_t i = 0; i < channel.values.size(); ++i)
        residuals.push_back(((*model)[c][i] - channel.values[i]) / (known ? channel.noise : scale));
    }
  }
  return residuals;
}

double rms_misfit(const EndochronicLaw& law, const MaterialExperiment& experiment, const ControlSettings& settings) {
  const auto model = respond(law, experiment, settings);
  if (!model) return std::numeric_limits<double>::infinity();
  double sum = 0.0, n = 0.0;
  for (std::size_t c = 0; c < model->size(); ++c)
    for (std::size_t i = 0; i < (*model)[c].size(); ++i, n += 1.0)
      sum += std::pow((*model)[c][i] - experiment.channels[c].values[i], 2);
  return std::sqrt(sum / n);
}

double rms_misfit(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                  const ControlSettings& settings) {
  double sum = 0.0, n = 0.0;
  for (const MaterialExperiment& experiment : experiments) {
    if (experiment.follows_stress) continue;
    const auto here = static_cast<double>(n_measured({experiment}));
    sum += here * std::pow(rms_misfit(law, experiment, settings), 2);
    n += here;
  }
  return std::sqrt(sum / n);
}

double relative_misfit(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                       const ControlSettings& settings) {
  double sum = 0.0, n = 0.0;
  for (const MaterialExperiment& experiment : experiments) {
    const auto here = static_cast<double>(n_measured({experiment}));
    const double scale = rms_measured(experiments, experiment.follows_stress);
    sum += here * std::pow(rms_misfit(law, experiment, settings) / scale, 2);
    n += here;
  }
  return std::sqrt(sum / n);
}

LawFit fit_law(const EndochronicLaw& law, const FitChoice& choice, const std::vector<MaterialExperiment>& experiments,
               const std::vector<FitParameter>& limits, const FitSettings& settings, const ControlSettings& control) {
  LawFit fitted{.law = law, .choice = choice, .parameters = {}, .result = {}};
  sort_kernel(fitted.law);
  // A second, short fit gives the statistics in the order of the sorted terms.
  for (const bool again : {false, true}) {
    fitted.parameters = fit_parameters(fitted.law, choice);
    set_limits(fitted.parameters, limits);
    const EndochronicLaw base = fitted.law;
    const FitProblem problem{.parameters = fitted.parameters,
                             .residuals = [&](std::span<const double> values) -> std::optional<std::vector<double>> {
                               const auto trial = with_values(base, choice, values);
                               if (!trial) return std::nullopt;
                               return fit_residuals(*trial, experiments, control);
                             },
                             .noise_is_known = noise_is_known(experiments)};
    FitSettings now = settings;
    if (again) now.starts = 1;
    if (law.hardening.depends_on_rate()) now.step = std::max(now.step, step_with_rate);
    fitted.result = fit(problem, now);
    fitted.law = *with_values(base, choice, fitted.result.values());
    const bool sorted = std::ranges::is_sorted(
        fitted.law.kernel, [](const KernelTerm& a, const KernelTerm& b) { return a.alpha > b.alpha; });
    if (sorted) break;
    sort_kernel(fitted.law);
  }
  return fitted;
}

}  // namespace pfdm
