#include "cases/program/point/endochronic_fit_case.h"

#include "cases/program/input/csv_columns.h"
#include "cases/program/point/control_values.h"
#include "cases/program/point/endochronic_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>

namespace pfdm {
namespace {

constexpr Range terms_range{1.0, 12.0, false, "between 1 and 12"};
constexpr Range starts_range{1.0, 1000.0, false, "between 1 and 1000"};

/// Strains that were measured are followed; pairs without one are free of stress.
LoadSegment read_followed_strains(const ConfigTable& table, const std::filesystem::path& directory,
                                  const CsvTable& file) {
  LoadSegment segment;
  segment.times = file_times(table, directory);
  for (int k = 0; k < n_components; ++k) {
    auto& condition = segment.conditions[static_cast<std::size_t>(k)];
    const std::string key = fmt::format("stress_{}", component_names[static_cast<std::size_t>(k)]);
    condition = {controlled_component(key).condition, Pace::follow, std::vector<double>(segment.times.size(), 0.0)};
  }
  const ConfigTable strains = table.table("strain");
  for (const auto& [key, value] : strains.entries()) {
    const ControlledComponent component = value.in_context([&name = key] { return controlled_component(name); });
    if (component.is_stress) throw value.error("expected a strain; stresses belong in [fit.experiments.stress]");
    segment.conditions[static_cast<std::size_t>(component.pair)] = {
        component.condition, Pace::follow,
        read_column(value.table().with_keys({"column", "unit"}), file, "column", "unit", dimension::number)};
  }
  if (strains.entries().empty()) throw strains.error("name at least one strain that the experiment followed");
  return segment;
}

MaterialExperiment::Channel read_channel(const std::string& key, const ConfigValue& value, const CsvTable& file) {
  const ControlledComponent component = value.in_context([&name = key] { return controlled_component(name); });
  if (!component.is_stress) throw value.error("expected a stress; strains belong in [fit.experiments.strain]");
  const ConfigTable table = value.table().with_keys({"column", "unit", "noise"});
  return {.component = component.pair,
          .stress = read_column(table, file, "column", "unit", dimension::stress),
          .noise = table.quantity("noise", dimension::stress, range::positive, 0.0)};
}

MaterialExperiment read_experiment(const ConfigTable& table, const std::filesystem::path& directory) {
  table.with_keys({"name", "csv", "separator", "decimal", "time", "time_unit", "strain", "stress", "predicted"});
  const CsvTable file = read_csv_of(table, directory);
  MaterialExperiment experiment{.name = table.string("name"), .loading = {}, .channels = {}};
  experiment.loading = read_followed_strains(table, directory, file);
  const ConfigTable stresses = table.table("stress");
  for (const auto& [key, value] : stresses.entries()) experiment.channels.push_back(read_channel(key, value, file));
  if (experiment.channels.empty()) throw stresses.error("no measured stress is named");
  for (const MaterialExperiment::Channel& channel : experiment.channels)
    if (experiment.loading.conditions[static_cast<std::size_t>(channel.component)].condition.on_strain.isZero())
      throw stresses.error(fmt::format("stress_{} was measured, but [fit.experiments.strain] does not name its strain",
                                       component_names[static_cast<std::size_t>(channel.component)]));
  return experiment;
}

/// `experiments`: those before this one.
void require_own_file(const ConfigTable& table, const std::vector<MaterialExperiment>& experiments) {
  const std::string name = table.string("name");
  for (const MaterialExperiment& other : experiments)
    if (fit_curve_file(other.name) == fit_curve_file(name))
      throw table.at("name").error(
          fmt::format("the curves of \"{}\" and \"{}\" would have the same file, {}: use names "
                      "with different letters or digits",
                      other.name, name, fit_curve_file(name)));
}

FitChoice read_choice(const ConfigTable& fit, const EndochronicLaw& law) {
  FitChoice choice;
  choice.rate = law.hardening.depends_on_rate();
  const auto list = fit.find("estimate");
  if (!list) return choice;
  choice = {.kernel = false, .hardening = false, .rate = false, .young_modulus = false};
  const std::string names[] = {"kernel", "hardening", "rate", "young_modulus"};
  for (const ConfigValue& entry : list->list()) {
    const std::string name = entry.one_of(names, "part of the law that can be estimated");
    choice.kernel |= name == "kernel";
    choice.hardening |= name == "hardening";
    choice.rate |= name == "rate";
    choice.young_modulus |= name == "young_modulus";
  }
  return choice;
}

void read_terms(const ConfigTable& fit, EndochronicIdentificationSettings& settings) {
  if (!fit.has("terms")) return;
  const auto terms = fit.at("terms").list(2);
  settings.least_terms = static_cast<int>(terms[0].integer(terms_range));
  settings.most_terms = static_cast<int>(terms[1].integer(terms_range));
  if (settings.least_terms > settings.most_terms)
    throw fit.at("terms").error("the first number of terms is larger than the second");
}

double read_parameter_value(const ConfigValue& value) {
  return value.is_string() ? value.quantity(dimension::stress, range::positive) : value.number(range::positive);
}

/// [fit.bounds] C_1 = ["1 GPa", "100 GPa"], f_inf = [1, 10] ...
void read_bounds(const ConfigTable& fit, const EndochronicLaw& law, EndochronicIdentificationSettings& settings) {
  if (!fit.has("bounds")) return;
  std::vector<std::string> names;
  EndochronicLaw longest = law;
  while (static_cast<int>(longest.kernel.size()) < settings.most_terms) longest.kernel.push_back({1.0, 1.0});
  for (const FitParameter& p : fit_parameters(longest, settings.choice)) names.push_back(p.name);
  for (const auto& [key, value] : fit.table("bounds").entries()) {
    if (std::ranges::count(names, key) == 0)
      throw value.error(fmt::format("\"{}\" is not estimated (available: {})", key, fmt::join(names, ", ")));
    const auto ends = value.list(2);
    const double lower = read_parameter_value(ends[0]), upper = read_parameter_value(ends[1]);
    if (!(lower < upper)) throw value.error("the lower bound must be below the upper one");
    settings.limits.push_back({.name = key, .unit = "", .first = lower, .lower = lower, .upper = upper});
  }
}

void require_noise_of_all_or_none(const ConfigTable& fit, const std::vector<MaterialExperiment>& experiments) {
  std::size_t with = 0, all = 0;
  for (const MaterialExperiment& experiment : experiments)
    for (const MaterialExperiment::Channel& channel : experiment.channels) {
      ++all;
      with += channel.noise > 0.0 ? 1 : 0;
    }
  if (with != 0 && with != all)
    throw fit.error(
        fmt::format("noise is given for {} of {} measured stresses; give it for all or for none", with, all));
}

}  // namespace

std::string fit_curve_file(const std::string& experiment) {
  std::string name = experiment;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return "fit_" + name + ".csv";
}

EndochronicFit read_endochronic_fit(const ConfigTable& fit, const EndochronicLaw& law,
                                    const std::filesystem::path& case_directory) {
  fit.with_keys({"method", "estimate", "terms", "starts", "largest_strain_increment", "bounds", "experiments"});
  EndochronicFit result;
  result.method = fit.has("method") ? &choose(fit.at("method"), identification_methods(), "method of identification")
                                    : &identification_method("joint");
  EndochronicIdentificationSettings& settings = result.settings;
  settings.choice = read_choice(fit, law);
  settings.fit.starts = static_cast<int>(fit.integer("starts", starts_range, 1));
  settings.control.largest_increment =
      fit.number("largest_strain_increment", range::positive, settings.control.largest_increment);
  read_terms(fit, settings);
  read_bounds(fit, law, settings);
  for (const ConfigTable& table : fit.tables("experiments")) {
    MaterialExperiment experiment = read_experiment(table, case_directory);
    require_own_file(table, result.experiments);
    require_own_file(table, result.predicted);
    (table.boolean("predicted", false) ? result.predicted : result.experiments).push_back(std::move(experiment));
    result.data_files.push_back(case_directory / table.string("csv"));
  }
  if (result.experiments.empty())
    throw fit.at("experiments").error("at least one of [[fit.experiments]] is required that is not predicted");
  std::vector<MaterialExperiment> all = result.experiments;
  all.insert(all.end(), result.predicted.begin(), result.predicted.end());
  require_noise_of_all_or_none(fit, all);
  return result;
}

}  // namespace pfdm
