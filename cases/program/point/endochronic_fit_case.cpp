#include "cases/program/point/endochronic_fit_case.h"

#include "cases/program/input/fields/csv_columns.h"
#include "cases/program/point/control_values.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "cases/program/point/endochronic_loading.h"
#include "cases/program/studies/fit/material_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

/// What [strain] or [stress] of an experiment says of a component; shear strains as tensor components.
struct MeasuredColumn {
  ControlledComponent component;
  std::vector<double> values;
  double noise = 0.0;
};

MeasuredColumn read_measured(const std::string& key, const ConfigValue& value, const CsvTable& file, bool is_stress,
                             bool with_noise) {
  const ControlledComponent component = value.in_context([&] { return controlled_component(key); });
  if (component.is_stress != is_stress)
    throw value.error(is_stress ? "expected a stress; strains belong in [fit.experiments.strain]"
                                : "expected a strain; stresses belong in [fit.experiments.stress]");
  const Dimension& due = is_stress ? dimension::stress : dimension::number;
  const ConfigTable table = value.table().with_keys(component_column_keys(), with_noise ? "measured" : "followed");
  MeasuredColumn column{.component = component, .values = read_column(table, file, "column", "unit", due)};
  if (with_noise) column.noise = read_noise(table, due);
  return column;
}

/// One component has two names in shear, strain_xy and gamma_xy. `seen`: the pairs of indices before.
void require_once(int pair, const ConfigValue& value, std::vector<int>& seen) {
  if (std::ranges::count(seen, pair) > 0)
    throw value.error(
        fmt::format("the component {} is given twice: strain and gamma are the same strain", component_names[pair]));
  seen.push_back(pair);
}

/// What was measured and is followed, strains or stresses; all other pairs are free of stress.
LoadSegment read_followed(const ConfigTable& followed, const CsvTable& file, std::vector<double> times,
                          bool is_stress) {
  LoadSegment segment;
  segment.times = std::move(times);
  for (int k = 0; k < n_components; ++k) {
    auto& condition = segment.conditions[k];
    const std::string key = fmt::format("stress_{}", component_names[k]);
    condition = {controlled_component(key).condition, Pace::follow, std::vector<double>(segment.times.size(), 0.0)};
  }
  std::vector<int> seen;
  for (const auto& [key, value] : followed.entries()) {
    MeasuredColumn column = read_measured(key, value, file, is_stress, false);
    require_once(column.component.pair, value, seen);
    segment.conditions[column.component.pair] = {column.component.condition, Pace::follow, std::move(column.values)};
  }
  if (followed.entries().empty())
    throw followed.error(
        fmt::format("name at least one {} that the experiment followed", is_stress ? "stress" : "strain"));
  return segment;
}

MaterialExperiment::Channel read_channel(const std::string& key, const ConfigValue& value, const CsvTable& file,
                                         bool is_stress) {
  MeasuredColumn column = read_measured(key, value, file, is_stress, true);
  const double tensor = key.starts_with("gamma") ? 0.5 : 1.0;
  for (double& entry : column.values) entry *= tensor;
  return {.component = column.component.pair, .values = std::move(column.values), .noise = tensor * column.noise};
}

/// A stress that was measured where the strain is free would be that of another test.
void require_strains_of(const MaterialExperiment& experiment, const ConfigTable& stresses) {
  for (const MaterialExperiment::Channel& channel : experiment.channels)
    if (experiment.loading.conditions[channel.component].condition.on_strain.isZero())
      throw stresses.error(fmt::format("stress_{} was measured, but [fit.experiments.strain] does not name its strain",
                                       component_names[channel.component]));
}

/// Of a law without rates the order of the rows is enough.
std::vector<double> times_or_order(const ConfigTable& table, const CsvTable& file, const EndochronicLaw& law) {
  if (table.has("time") || std::ranges::count(file.names, "time_s") > 0) return read_times(table, file);
  if (law.hardening.depends_on_rate())
    throw table.error("the law depends on the rate, so the times are needed: \"time\" names their column");
  table.at("csv").remark("it has no times: its rows are taken in their order, which is enough of a law without rates");
  std::vector<double> order(file.n_rows());
  std::iota(order.begin(), order.end(), 0.0);
  return order;
}

/// Rows with an empty entry in a column that the experiment uses belong to none of them.
void leave_out_gaps_of(MaterialExperiment& experiment, const ConfigTable& table) {
  std::vector<std::vector<double>*> used{&experiment.loading.times};
  for (LoadSegment::Condition& condition : experiment.loading.conditions) used.push_back(&condition.values);
  for (MaterialExperiment::Channel& channel : experiment.channels) used.push_back(&channel.values);
  leave_out_gaps(table, used);
  begin_at_zero(table, experiment.loading.times);
}

MaterialExperiment read_experiment(const ConfigTable& table, const EndochronicLaw& law,
                                   const std::filesystem::path& directory) {
  const CsvTable file = read_csv_of(table, directory);
  MaterialExperiment experiment{.name = table.string("name"), .loading = {}, .channels = {}};
  experiment.follows_stress = table.choice("controlled", "strain") == "stress";
  const bool stress = experiment.follows_stress;
  experiment.loading =
      read_followed(table.table(stress ? "stress" : "strain"), file, times_or_order(table, file, law), stress);
  const ConfigTable measured = table.table(stress ? "strain" : "stress");
  std::vector<int> seen;
  for (const auto& [key, value] : measured.entries()) {
    experiment.channels.push_back(read_channel(key, value, file, !stress));
    require_once(experiment.channels.back().component, value, seen);
  }
  if (experiment.channels.empty())
    throw measured.error(fmt::format("no measured {} is named", stress ? "strain" : "stress"));
  if (!stress) require_strains_of(experiment, measured);
  leave_out_gaps_of(experiment, table);
  return experiment;
}

FitChoice read_choice(const ConfigTable& fit, const EndochronicLaw& law) {
  FitChoice choice;
  choice.rate = law.hardening.depends_on_rate();
  const auto list = fit.find("estimate");
  if (!list) return choice;
  choice = {.kernel = false, .hardening = false, .rate = false, .young_modulus = false};
  for (const ConfigValue& entry : list->list()) {
    const std::string name = entry.choice();
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
  settings.least_terms = static_cast<int>(terms[0].integer());
  settings.most_terms = static_cast<int>(terms[1].integer());
  if (settings.least_terms > settings.most_terms)
    throw fit.at("terms").error("the first number of terms is larger than the second");
}

double read_parameter_value(const ConfigValue& value) { return value.is_string() ? value.quantity() : value.number(); }

/// [fit.bounds] C_1 = ["1 GPa", "100 GPa"], f_inf = [1, 10] ...
void read_bounds(const ConfigTable& fit, const EndochronicLaw& law, EndochronicIdentificationSettings& settings) {
  if (!fit.has("bounds")) return;
  EndochronicLaw longest = law;
  while (static_cast<int>(longest.kernel.size()) < settings.most_terms) longest.kernel.push_back({1.0, 1.0});
  settings.limits =
      read_fit_bounds(fit, fit_parameters(longest, settings.choice),
                      [](const FitParameter&, const ConfigValue& end) { return read_parameter_value(end); });
}

void require_noise_of_all_or_none(const ConfigTable& fit, const std::vector<MaterialExperiment>& experiments) {
  std::size_t with = 0, all = 0;
  for (const MaterialExperiment& experiment : experiments)
    for (const MaterialExperiment::Channel& channel : experiment.channels) {
      ++all;
      with += channel.noise > 0.0 ? 1 : 0;
    }
  require_noise_of_all_or_none(fit, with, all, "curves");
}

}  // namespace

EndochronicFit read_endochronic_fit(const ConfigTable& fit, const EndochronicLaw& law,
                                    const std::filesystem::path& case_directory) {
  EndochronicFit result;
  result.method = fit.has("method") ? &choose(fit.at("method"), identification_methods(), "method of identification")
                                    : &identification_method("joint");
  EndochronicIdentificationSettings& settings = result.settings;
  settings.choice = read_choice(fit, law);
  settings.fit.starts = static_cast<int>(fit.integer("starts", std::int64_t{1}));
  settings.control.largest_increment = fit.number("largest_strain_increment", settings.control.largest_increment);
  settings.control.substeps = static_cast<int>(fit.integer("substeps", std::int64_t{1}));
  result.divides_steps = !fit.has("substeps");
  read_terms(fit, settings);
  read_bounds(fit, law, settings);
  for (const ConfigTable& table : fit.tables("experiments")) {
    MaterialExperiment experiment = read_experiment(table, law, case_directory);
    for (const auto* before : {&result.experiments, &result.predicted})
      for (const MaterialExperiment& other : *before) require_own_file(table, other.name);
    (table.boolean("predicted", false) ? result.predicted : result.experiments).push_back(std::move(experiment));
    result.data_files.push_back(case_directory / table.string("csv"));
  }
  if (std::ranges::all_of(result.experiments, &MaterialExperiment::follows_stress))
    throw fit.at("experiments")
        .error("at least one of [[fit.experiments]] is required that is not predicted and has measured stresses");
  std::vector<MaterialExperiment> all = result.experiments;
  all.insert(all.end(), result.predicted.begin(), result.predicted.end());
  require_noise_of_all_or_none(fit, all);
  return result;
}

}  // namespace pfdm
