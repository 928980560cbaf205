#include "solver/point/viscoelastic_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double unknown_part = 0.01;   // deviation of noise that is not known, before there is a fit
constexpr double least_scatter = 1e-6;  // of values that the law meets but for rounding
constexpr double reach_of_modulus = 1e7, reach_of_time = 1e3;
constexpr double least_modulus = 1e-3, largest_modulus = 1e15;  // [Pa], as cases take them
constexpr double reach_of_shift = 100.0;
constexpr double least_nu = -0.99, largest_nu = 0.4999;

/// Calls visit(name, unit, value) for every chosen value of the branches.
template <class Branches, class Visit>
void visit_branches(Branches& branches, const ViscoelasticChoice& choice, const Visit& visit) {
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (choice.moduli) visit(fmt::format("modulus_{}", i + 1), "Pa", branches[i].modulus);
    if (choice.times) visit(fmt::format("time_{}", i + 1), "s", branches[i].time);
  }
}

/// The same for the constants of the temperature shift.
template <class Shift, class Visit>
void visit_shift(Shift& shift, const ViscoelasticChoice& choice, const Visit& visit) {
  if (!choice.shift || !shift) return;
  if (shift->law == TemperatureShift::Law::arrhenius) {
    visit("activation_energy", "J/mol", shift->activation_energy);
  } else {
    visit("C1", "1", shift->c1);
    visit("C2", "K", shift->c2);
  }
}

FitParameter on_log_scale(std::string name, std::string_view unit, double first, double lower, double upper) {
  return {.name = std::move(name),
          .unit = std::string(unit),
          .first = std::clamp(first, lower, upper),
          .lower = lower,
          .upper = upper,
          .log_scale = true};
}

std::vector<double> response_over_time(const RelaxationModulus& modulus, const ViscoelasticExperiment& experiment) {
  const LoadPath path = whole_path(experiment, experiment.followed);
  std::vector<double> answer = experiment.follows_stress
                                   ? strain_response(creep_compliance(modulus), path.times, path.followed)
                                   : stress_response(modulus, path.times, path.followed);
  answer.erase(answer.begin(), answer.begin() + path.added);
  return answer;
}

double of_complex(std::complex<double> modulus, MeasuredQuantity quantity) {
  if (quantity == MeasuredQuantity::storage_modulus) return modulus.real();
  if (quantity == MeasuredQuantity::loss_modulus) return modulus.imag();
  return modulus.imag() / modulus.real();
}

bool is_known(const ViscoelasticExperiment::Channel& channel) {
  return channel.noise > 0.0 || channel.relative_noise > 0.0;
}

/// What the deviations of a channel are in proportion to, by the law's values.
std::vector<double> scales(const ViscoelasticExperiment& experiment, const ViscoelasticExperiment::Channel& channel,
                           const std::vector<double>& model) {
  const bool relative = is_known(channel) ? channel.relative_noise > 0.0 : experiment.is_frequency_sweep();
  std::vector<double> result(model.size(), is_known(channel) ? 1.0 : rms_of(channel.values));
  // A history begins at zero, where a share of the value would be no noise at all.
  const double least = (experiment.is_frequency_sweep() ? 1e-9 : 1e-2) * rms_of(channel.values);
  if (relative)
    for (std::size_t i = 0; i < model.size(); ++i) result[i] = std::max(std::abs(model[i]), least);
  return result;
}

void append_deviations(const ViscoelasticExperiment& experiment, std::size_t c, const std::vector<double>& model,
                       bool by_scatter, std::vector<double>& all) {
  const ViscoelasticExperiment::Channel& channel = experiment.channels[c];
  const std::vector<double> scale = scales(experiment, channel, model);
  double part = channel.noise > 0.0 ? channel.noise : channel.relative_noise;
  if (!is_known(channel)) {
    std::vector<double> relative;
    for (std::size_t i = 0; i < model.size(); ++i) relative.push_back((model[i] - channel.values[i]) / scale[i]);
    part = by_scatter ? std::max(rms_of(relative), least_scatter) : unknown_part;
  }
  for (const double s : scale) all.push_back(part * s);
}

}  // namespace

double rms_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

std::string_view name_of(MeasuredQuantity quantity) {
  constexpr std::string_view names[] = {"stress", "strain", "storage modulus", "loss modulus", "loss factor"};
  return names[static_cast<std::size_t>(quantity)];
}

std::string_view unit_of(MeasuredQuantity quantity) {
  return quantity == MeasuredQuantity::strain || quantity == MeasuredQuantity::loss_factor ? "1" : "Pa";
}

std::vector<FitParameter> fit_parameters(const PronyLaw& law, const ViscoelasticChoice& choice,
                                         const TimeWindow& window) {
  std::vector<FitParameter> parameters;
  const double E = law.relaxed.young_modulus();
  if (choice.young_modulus)
    parameters.push_back(on_log_scale("young_modulus", "Pa", E, E / reach_of_modulus, E * reach_of_modulus));
  visit_branches(law.shear, choice, [&](std::string name, std::string_view unit, double value) {
    const bool is_time = unit == "s";
    const bool has_window = is_time && window.longest > 0.0;
    if (!is_time) value = std::max(value, least_modulus);
    const double lower = has_window ? window.shortest / reach_of_time : value / reach_of_modulus;
    const double upper = has_window ? window.longest * reach_of_time : value * reach_of_modulus;
    parameters.push_back(on_log_scale(std::move(name), unit, value, std::max(lower, is_time ? 1e-15 : least_modulus),
                                      is_time ? upper : std::min(upper, largest_modulus)));
  });
  visit_shift(law.shift, choice, [&](std::string name, std::string_view unit, double value) {
    parameters.push_back(on_log_scale(std::move(name), unit, value, value / reach_of_shift, value * reach_of_shift));
  });
  if (choice.poisson_ratio)
    parameters.push_back({.name = "poisson_ratio",
                          .unit = "1",
                          .first = std::clamp(law.relaxed.poisson_ratio(), least_nu, largest_nu),
                          .lower = least_nu,
                          .upper = largest_nu});
  return parameters;
}

std::optional<PronyLaw> with_values(const PronyLaw& law, const ViscoelasticChoice& choice,
                                    std::span<const double> values) {
  PronyLaw result = law;
  std::size_t i = 0;
  double E = law.relaxed.young_modulus();
  if (choice.young_modulus) E = values[i++];
  visit_branches(result.shear, choice,
                 [&](const std::string&, std::string_view, double& value) { value = values[i++]; });
  visit_shift(result.shift, choice, [&](const std::string&, std::string_view, double& value) { value = values[i++]; });
  const double nu = choice.poisson_ratio ? values[i++] : law.relaxed.poisson_ratio();
  result.relaxed = from_young_poisson(E, nu);
  bool is_law = E > 0.0 && std::isfinite(E) && nu > -1.0 && nu < 0.5;
  for (const PronyBranch& b : result.shear)
    is_law = is_law && b.modulus > 0.0 && b.time > 0.0 && std::isfinite(b.modulus * b.time);
  return is_law ? std::optional(result) : std::nullopt;
}

std::vector<std::vector<double>> respond(const PronyLaw& law, const ViscoelasticExperiment& experiment) {
  if (law.shift && !experiment.temperatures.empty()) return respond(law, at_reference(experiment, law.shift));
  const RelaxationModulus modulus = modulus_in(law, experiment.deformation);
  std::vector<std::vector<double>> answers;
  for (const ViscoelasticExperiment::Channel& channel : experiment.channels) {
    if (!experiment.is_frequency_sweep()) {
      answers.push_back(response_over_time(modulus, experiment));
      continue;
    }
    answers.emplace_back();
    for (const double w : experiment.angular_frequencies)
      answers.back().push_back(of_complex(complex_modulus(modulus, w), channel.quantity));
  }
  return answers;
}

bool noise_is_known(const ViscoelasticExperiments& experiments) {
  return std::ranges::all_of(experiments, [](const ViscoelasticExperiment& experiment) {
    return std::ranges::all_of(experiment.channels, is_known);
  });
}

std::size_t n_measured(const ViscoelasticExperiments& experiments) {
  std::size_t n = 0;
  for (const ViscoelasticExperiment& experiment : experiments)
    for (const ViscoelasticExperiment::Channel& channel : experiment.channels) n += channel.values.size();
  return n;
}

std::vector<double> deviations(const PronyLaw& law, const ViscoelasticExperiments& experiments) {
  std::vector<double> all;
  for (const ViscoelasticExperiment& experiment : experiments) {
    const auto model = respond(law, experiment);
    for (std::size_t c = 0; c < model.size(); ++c) append_deviations(experiment, c, model[c], true, all);
  }
  return all;
}

std::vector<double> first_deviations(const ViscoelasticExperiments& experiments) {
  std::vector<double> all;
  for (const ViscoelasticExperiment& experiment : experiments)
    for (std::size_t c = 0; c < experiment.channels.size(); ++c)
      append_deviations(experiment, c, experiment.channels[c].values, false, all);
  return all;
}

std::vector<double> fit_residuals(const PronyLaw& law, const ViscoelasticExperiments& experiments,
                                  std::span<const double> deviations) {
  std::vector<double> residuals;
  for (const ViscoelasticExperiment& experiment : experiments) {
    const auto model = respond(law, experiment);
    for (std::size_t c = 0; c < model.size(); ++c)
      for (std::size_t i = 0; i < model[c].size(); ++i)
        residuals.push_back((model[c][i] - experiment.channels[c].values[i]) / deviations[residuals.size()]);
  }
  return residuals;
}

std::vector<double> relative_misfits(const PronyLaw& law, const ViscoelasticExperiment& experiment) {
  std::vector<double> parts;
  auto model = respond(law, experiment);
  for (std::size_t c = 0; c < model.size(); ++c) {
    const std::vector<double>& measured = experiment.channels[c].values;
    for (std::size_t i = 0; i < measured.size(); ++i) model[c][i] -= measured[i];
    parts.push_back(rms_of(model[c]) / rms_of(measured));
  }
  return parts;
}

double relative_misfit(const PronyLaw& law, const ViscoelasticExperiments& experiments) {
  double largest = 0.0;
  for (const ViscoelasticExperiment& experiment : experiments)
    for (const double part : relative_misfits(law, experiment)) largest = std::max(largest, part);
  return largest;
}

ViscoelasticFit fit_law(const PronyLaw& law, const ViscoelasticChoice& choice,
                        const ViscoelasticExperiments& experiments, std::span<const double> deviations,
                        const std::vector<FitParameter>& limits, const FitSettings& settings) {
  ViscoelasticFit fitted{.law = law, .choice = choice, .parameters = {}, .result = {}};
  const TimeWindow window = time_window(at_reference(experiments, law.shift));
  std::ranges::sort(fitted.law.shear, {}, &PronyBranch::time);
  // A second, short fit gives the statistics in the order of the sorted branches.
  for (int turn = 0; turn < 2; ++turn) {
    fitted.parameters = fit_parameters(fitted.law, choice, window);
    set_limits(fitted.parameters, limits);
    const PronyLaw base = fitted.law;
    fitted.result = fit({.parameters = fitted.parameters,
                         .residuals = [&](std::span<const double> values) -> std::optional<std::vector<double>> {
                           const auto trial = with_values(base, choice, values);
                           if (!trial) return std::nullopt;
                           return fit_residuals(*trial, experiments, deviations);
                         },
                         .noise_is_known = noise_is_known(experiments)},
                        settings);
    fitted.law = *with_values(base, choice, fitted.result.values());
    if (turn == 1 || std::ranges::is_sorted(fitted.law.shear, {}, &PronyBranch::time)) break;
    std::ranges::sort(fitted.law.shear, {}, &PronyBranch::time);
  }
  return fitted;
}

}  // namespace pfdm
