#include "cases/program/point/endochronic_comparison.h"

#include "cases/program/studies/fit/material_tests.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/json.h"
#include "postproc/files/unit_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace pfdm {

namespace {

/// "stress_xx_Pa" or "strain_xx", and what it is along a history.
std::string column_name(bool is_stress, int component) {
  const auto name = component_names[component];
  return is_stress ? fmt::format("stress_{}_Pa", name) : fmt::format("strain_{}", name);
}

std::vector<double> along(const HistoryResult& history, bool is_stress, int component) {
  std::vector<double> values;
  for (const HistoryPoint& point : history.points)
    values.push_back((is_stress ? point.stress : point.state.strain)[component] / mandel_factor(component));
  return values;
}

/// Whether pair k of an experiment is not just free of stress.
bool is_followed(const MaterialExperiment& experiment, std::size_t k) {
  const LoadSegment::Condition& c = experiment.loading.conditions[k];
  const bool strain = !c.condition.on_strain.isZero();
  if (!experiment.follows_stress) return strain;
  return !strain && std::ranges::any_of(c.values, [](double value) { return value != 0.0; });
}

}  // namespace

CsvTable answered_curve(const MaterialExperiment& experiment, const EndochronicLaw& law, const ControlSettings& control,
                        std::string_view answer) {
  const bool stress_is_followed = experiment.follows_stress;
  CsvTable table;
  table.comments.push_back(fmt::format("experiment {}: measured {} and that of the law", experiment.name,
                                       stress_is_followed ? "strain" : "stress"));
  table.add("time_s", experiment.loading.times);
  const HistoryResult history = run_history(law, {experiment.loading}, control);
  if (!history.converged) throw ComputationError(fmt::format("experiment {}: {}", experiment.name, history.failure));
  for (int k = 0; k < n_components; ++k)
    if (is_followed(experiment, static_cast<std::size_t>(k)))
      table.add(column_name(stress_is_followed, k), along(history, stress_is_followed, k));
  for (const MaterialExperiment::Channel& channel : experiment.channels) {
    const std::string name = column_name(!stress_is_followed, channel.component);
    table.add("measured_" + name, channel.values);
    table.add(fmt::format("{}_{}", answer, name), along(history, !stress_is_followed, channel.component));
  }
  return table;
}

std::vector<ExperimentMisfit> experiment_misfits(const EndochronicFit& fit, const EndochronicLaw& law) {
  std::vector<ExperimentMisfit> result;
  for (const auto& [experiments, fitted] : {std::pair(&fit.experiments, true), std::pair(&fit.predicted, false)})
    for (const MaterialExperiment& experiment : *experiments) {
      const bool strains = experiment.follows_stress;
      result.push_back(experiment_misfit(experiment.name, n_measured({experiment}),
                                         {.rms = rms_misfit(law, experiment, fit.settings.control),
                                          .rms_measured = rms_measured({experiment}, strains),
                                          .quantity = strains ? "strain" : "stress",
                                          .unit = strains ? "1" : "Pa"},
                                         fit_curve_file(experiment.name)));
      result.back().fitted = fitted;
    }
  return result;
}

void compare_with_experiments(const EndochronicFit& fit, const EndochronicLaw& law, const std::string& case_name,
                              const std::string& case_hash, Session& session) {
  const FolderLock lock(session.results);
  auto list = nlohmann::ordered_json::array();
  std::vector<CsvTable> curves;
  for (const auto* experiments : {&fit.experiments, &fit.predicted})
    for (const MaterialExperiment& experiment : *experiments)
      curves.push_back(answered_curve(experiment, law, fit.settings.control, "computed"));
  const std::vector<ExperimentMisfit> misfits = experiment_misfits(fit, law);
  for (std::size_t i = 0; i < misfits.size(); ++i) {
    const ExperimentMisfit& m = misfits[i];
    const std::string file = "comparison_" + m.curve.substr(m.curve.find('_') + 1);
    const auto& [quantity, unit] = std::tie(m.absolute->quantity, m.absolute->unit);
    write_csv(session.results / file, curves[i]);
    list.push_back({{"name", m.name},
                    {"data", m.n_data},
                    {"relative_misfit", m.relative},
                    {key_with_unit("rms_misfit", unit), m.absolute->rms},
                    {key_with_unit("rms_" + quantity, unit), m.absolute->rms_measured},
                    {"curve", file}});
    session.log.say(fmt::format("{:<24} rms misfit {:.4g}{}, {:.3g} % of the rms {}", m.name, m.absolute->rms,
                                unit == "1" ? "" : " " + unit, 100.0 * m.relative, quantity));
  }
  const nlohmann::ordered_json json = {
      {"case", case_name}, {"case_hash", case_hash}, {"pfdm_version", session.version}, {"experiments", list}};
  write_file(session.results / "comparison.json", json_text(json));
  session.log.say(fmt::format("written to {}", session.results.string()));
}

}  // namespace pfdm
