#include "cases/program/point/endochronic_fit_results.h"

#include "cases/program/point/endochronic_material.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// What was followed, what was measured and what the fitted law answers.
CsvTable curve(const MaterialExperiment& experiment, const EndochronicLaw& law, const ControlSettings& control) {
  CsvTable table;
  table.comments.push_back(fmt::format("experiment {}: measured stress and that of the fitted law", experiment.name));
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
    table.add(fmt::format("fitted_stress_{}_Pa", name), std::move(fitted));
  }
  return table;
}

std::vector<ExperimentMisfit> misfits(const EndochronicFit& fit, const EndochronicLaw& law) {
  std::vector<ExperimentMisfit> result;
  for (const MaterialExperiment& experiment : fit.experiments) {
    std::size_t n = 0;
    for (const auto& channel : experiment.channels) n += channel.stress.size();
    result.push_back(experiment_misfit(experiment.name, n,
                                       {.rms = rms_misfit(law, experiment, fit.settings.control),
                                        .rms_measured = rms_stress({experiment}),
                                        .quantity = "stress",
                                        .unit = "Pa"},
                                       fit_curve_file(experiment.name)));
  }
  return result;
}

constexpr double negligible_misfit = 1e-4;  // of the rms stress: what steps and rounding leave

/// The residuals of each channel of each experiment.
std::vector<ResidualSeries> series_of(const EndochronicFit& fit, const std::vector<double>& residuals) {
  std::vector<ResidualSeries> result;
  auto at = residuals.begin();
  for (const MaterialExperiment& experiment : fit.experiments)
    for (const MaterialExperiment::Channel& channel : experiment.channels) {
      const auto end = at + std::ssize(channel.stress);
      result.push_back({.name = fmt::format("{}, stress_{}", experiment.name,
                                            component_names[static_cast<std::size_t>(channel.component)]),
                        .along = "time",
                        .values = {at, end}});
      at = end;
    }
  return result;
}

/// What doubts about the fit say of the law. Terms of the kernel that saturate at once stand for a yield surface.
void suspect_law(const EndochronicLaw& law, double misfit, bool model_error, FitFindings& findings) {
  constexpr double rigid = 10.0;
  const double largest = std::ranges::max(law.kernel, {}, &KernelTerm::C).C / law.elasticity.young_modulus();
  if (model_error)
    findings.reasons.push_back(
        fmt::format("the law with {} kernel terms is the wrong model for these curves, which it misses by {:.2g} %",
                    law.kernel.size(), 100.0 * misfit));
  if (findings.verdict != Verdict::sound && largest > rigid)
    findings.reasons.push_back(
        fmt::format("a C of {:.3g} times Young's modulus stands for an elastic range: a law with a yield surface, as "
                    "Chaboche's, has one, the endochronic law has not",
                    largest));
}

FitFindings judged(const EndochronicFit& fit, const EndochronicIdentification& found) {
  FitFindings findings = findings_of(found.fit.parameters, found.fit.result);
  if (!found.remark.empty()) findings.warnings.push_back(found.remark);
  const double misfit = rms_misfit(found.fit.law, fit.experiments, fit.settings.control) / rms_stress(fit.experiments);
  const bool model_error =
      judge(findings,
            {.series = series_of(fit, found.fit.result.residuals), .negligible = negligible_misfit, .misfit = misfit});
  suspect_law(found.fit.law, misfit, model_error, findings);
  return findings;
}

}  // namespace

FitFindings write_fit_results(const fs::path& results, const CaseFile& file, const EndochronicFit& fit,
                              const EndochronicIdentification& found, const FitRun& run) {
  for (const MaterialExperiment& experiment : fit.experiments)
    write_csv(results / fit_curve_file(experiment.name), curve(experiment, found.fit.law, fit.settings.control));
  for (std::size_t i = 0; i < found.transients.size(); ++i) {
    CsvTable table;
    std::vector<double> zeta, rate, f, weight;
    for (const HardeningPoint& p : found.transients[i])
      zeta.push_back(p.zeta), rate.push_back(p.rate), f.push_back(p.f), weight.push_back(p.weight);
    table.add("zeta", std::move(zeta));
    table.add("zeta_rate_per_s", std::move(rate));
    table.add("f", std::move(f));
    table.add("weight_Pa", std::move(weight));
    write_csv(results / ("transient_" + fit_curve_file(fit.experiments[i].name)), table);
  }
  write_file(results / "case.fitted.toml",
             with_table(file, "material", "# estimated by pfdm fit\n" + to_toml(found.fit.law) + "\n", results));
  const FitReport report{.case_name = run.case_name,
                         .case_hash = run.case_hash,
                         .version = run.version,
                         .method = std::string(fit.method->name),
                         .wall_seconds = run.wall_seconds,
                         .found = judged(fit, found),
                         .experiments = misfits(fit, found.fit.law),
                         .own = EndochronicFindings{found.tried, found.rounds}};
  write_fit_json(results / "fit.json", report);
  return report.found;
}

}  // namespace pfdm
