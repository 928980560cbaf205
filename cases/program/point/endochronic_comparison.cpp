#include "cases/program/point/endochronic_comparison.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

#include <utility>

namespace pfdm {

CsvTable answered_curve(const MaterialExperiment& experiment, const EndochronicLaw& law, const ControlSettings& control,
                        std::string_view answer) {
  CsvTable table;
  table.comments.push_back(fmt::format("experiment {}: measured stress and that of the law", experiment.name));
  table.add("time_s", experiment.loading.times);
  const HistoryResult history = run_history(law, {experiment.loading}, control);
  if (!history.converged) throw ComputationError(fmt::format("experiment {}: {}", experiment.name, history.failure));
  for (int k = 0; k < n_components; ++k) {
    const auto name = component_names[static_cast<std::size_t>(k)];
    if (experiment.loading.conditions[static_cast<std::size_t>(k)].condition.on_strain.isZero()) continue;
    std::vector<double> strain;
    for (const HistoryPoint& point : history.points) strain.push_back(point.state.strain[k] / mandel_factor(k));
    table.add(fmt::format("strain_{}", name), std::move(strain));
  }
  for (const MaterialExperiment::Channel& channel : experiment.channels) {
    const auto name = component_names[static_cast<std::size_t>(channel.component)];
    std::vector<double> fitted;
    for (const HistoryPoint& point : history.points)
      fitted.push_back(point.stress[channel.component] / mandel_factor(channel.component));
    table.add(fmt::format("measured_stress_{}_Pa", name), channel.stress);
    table.add(fmt::format("{}_stress_{}_Pa", answer, name), std::move(fitted));
  }
  return table;
}

std::vector<ExperimentMisfit> experiment_misfits(const EndochronicFit& fit, const EndochronicLaw& law) {
  std::vector<ExperimentMisfit> result;
  for (const auto& [experiments, fitted] : {std::pair(&fit.experiments, true), std::pair(&fit.predicted, false)})
    for (const MaterialExperiment& experiment : *experiments) {
      std::size_t n = 0;
      for (const auto& channel : experiment.channels) n += channel.stress.size();
      result.push_back(experiment_misfit(experiment.name, n,
                                         {.rms = rms_misfit(law, experiment, fit.settings.control),
                                          .rms_measured = rms_stress({experiment}),
                                          .quantity = "stress",
                                          .unit = "Pa"},
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
    write_csv(session.results / file, curves[i]);
    list.push_back({{"name", m.name},
                    {"data", m.n_data},
                    {"relative_misfit", m.relative},
                    {"rms_misfit_Pa", m.absolute->rms},
                    {"rms_stress_Pa", m.absolute->rms_measured},
                    {"curve", file}});
    session.log.say(fmt::format("{:<24} rms misfit {:.4g} Pa, {:.3g} % of the rms stress", m.name, m.absolute->rms,
                                100.0 * m.relative));
  }
  const nlohmann::ordered_json json = {
      {"case", case_name}, {"case_hash", case_hash}, {"pfdm_version", session.version}, {"experiments", list}};
  write_file(session.results / "comparison.json", json.dump(2) + "\n");
  session.log.say(fmt::format("written to {}", session.results.string()));
}

}  // namespace pfdm
