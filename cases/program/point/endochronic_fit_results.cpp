#include "cases/program/point/endochronic_fit_results.h"

#include "cases/program/input/laws/endochronic_reader.h"
#include "cases/program/point/endochronic_comparison.h"
#include "cases/program/studies/fit/material_tests.h"
#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_judgement.h"
#include "postproc/fits/record_doubts.h"
#include "postproc/point/endochronic_fit.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr double negligible_misfit = 1e-4;  // of the rms measured: what steps and rounding leave
constexpr double most_of_noise = 0.01;      // likewise; correlated residuals above are an error of the law

/// The residuals of each channel of each experiment.
std::vector<ResidualSeries> series_of(const EndochronicFit& fit, const std::vector<double>& residuals) {
  std::vector<ResidualSeries> result;
  auto at = residuals.begin();
  for (const MaterialExperiment& experiment : fit.experiments)
    for (const MaterialExperiment::Channel& channel : experiment.channels) {
      const auto end = at + std::ssize(channel.values);
      result.push_back(
          {.name = fmt::format("{}, {}_{}", experiment.name, experiment.follows_stress ? "strain" : "stress",
                               component_names[channel.component]),
           .along = "time",
           .values = {at, end}});
      at = end;
    }
  return result;
}

std::vector<FittedRecord> records_of(const EndochronicFit& fit, const EndochronicLaw& law) {
  const bool known = noise_is_known(fit.experiments);
  std::vector<FittedRecord> records;
  for (const MaterialExperiment& test : fit.experiments) {
    const auto answered = respond(law, test, fit.settings.control).value();
    const double rms = rms_measured(fit.experiments, test.follows_stress);
    for (std::size_t c = 0; c < test.channels.size(); ++c)
      records.push_back(
          record_of({.test = test.name,
                     .quantity = test.follows_stress ? "strain" : "stress",
                     .unit = test.follows_stress ? "1" : "Pa",
                     .measured = test.channels[c].values,
                     .answered = answered[c],
                     .usual = rms,
                     .deviation = [by = known ? test.channels[c].noise : rms](std::size_t) { return by; },
                     .at = [&test](std::size_t i) { return quantity_text(test.loading.times[i], "s", 4); }}));
  }
  return records;
}

/// What doubts about the fit say of the law. Terms of the kernel that saturate at once stand for a yield surface.
void suspect_law(const EndochronicLaw& law, double misfit, bool model_error, FitFindings& findings) {
  constexpr double rigid = 10.0;
  if (is_sound(findings.verdict)) return;
  const double largest = std::ranges::max(law.kernel, {}, &KernelTerm::C).C / law.elasticity.young_modulus();
  if (model_error)
    findings.reasons.push_back(
        fmt::format("the law with {} kernel terms is the wrong model for these curves, which it misses by {:.2g} %",
                    law.kernel.size(), 100.0 * misfit));
  if (largest > rigid)
    findings.reasons.push_back(
        fmt::format("a C of {:.3g} times Young's modulus stands for an elastic range: a law with a yield surface, as "
                    "Chaboche's, has one, the endochronic law has not",
                    largest));
}

/// Predicted experiments that the law misses by more than those that it was fitted to: by more than twice the noise or,
/// where that is not known, by more than three times as large a part of the stress.
std::vector<std::string> failed_predictions(const EndochronicFit& fit, const EndochronicLaw& law, double misfit) {
  constexpr double noises = 2.0, times = 3.0;
  std::vector<std::string> reasons;
  for (const MaterialExperiment& experiment : fit.predicted) {
    const double relative =
        rms_misfit(law, experiment, fit.settings.control) / rms_measured({experiment}, experiment.follows_stress);
    const auto residuals = fit_residuals(law, {experiment}, fit.settings.control);
    double squares = 0.0;
    if (residuals)
      for (const double r : *residuals) squares += r * r;
    const bool known = noise_is_known({experiment});
    const bool missed = !residuals || (known ? squares > noises * noises * static_cast<double>(residuals->size())
                                             : relative > times * std::max(misfit, negligible_misfit));
    if (missed)
      reasons.push_back(fmt::format("\"{}\" is predicted with a misfit of {:.2g} %, {}", experiment.name,
                                    100.0 * relative,
                                    known ? "more than twice its noise"
                                          : fmt::format("the fitted curves are met within {:.2g} %", 100.0 * misfit)));
  }
  return reasons;
}

/// The law with steps of a quarter.
std::optional<FinerModel> with_quarter_steps(const EndochronicFit& fit, const EndochronicIdentification& found) {
  ControlSettings finer = fit.settings.control;
  finer.substeps *= 4;
  auto residuals = fit_residuals(found.fit.law, fit.experiments, finer);
  if (!residuals) return std::nullopt;
  return FinerModel{fmt::format("substeps = {}", finer.substeps), std::move(*residuals)};
}

FitFindings judged(const EndochronicFit& fit, const EndochronicIdentification& found) {
  FitFindings findings = findings_of(found.fit.parameters, found.fit.result);
  if (!found.remark.empty()) findings.warnings.push_back(found.remark);
  const double misfit = relative_misfit(found.fit.law, fit.experiments, fit.settings.control);
  const bool model_error =
      judge(findings, {.series = series_of(fit, found.fit.result.residuals),
                       .result = &found.fit.result,
                       .correlated_is_noise = misfit < most_of_noise,
                       .negligible = negligible_misfit,
                       .misfit = misfit,
                       .reasons = failed_predictions(fit, found.fit.law, misfit),
                       .finer = misfit < negligible_misfit ? std::nullopt : with_quarter_steps(fit, found)});
  suspect_law(found.fit.law, misfit, model_error, findings);
  const std::vector<FittedRecord> records = records_of(fit, found.fit.law);
  doubt_stray_row(found.fit.result, records, negligible_misfit, findings);
  widen_for_uneven_scatter(found.fit.result, records, negligible_misfit,
                           "such noise cannot be stated, which leaves the estimates less exact than they could be",
                           findings);
  return findings;
}

}  // namespace

FitFindings write_fit_results(const fs::path& results, const CaseFile& file, const EndochronicFit& fit,
                              const EndochronicIdentification& found, const FitRun& run) {
  for (const auto* experiments : {&fit.experiments, &fit.predicted})
    for (const MaterialExperiment& experiment : *experiments)
      write_csv(results / fit_curve_file(experiment.name),
                answered_curve(experiment, found.fit.law, fit.settings.control, "fitted"));
  for (std::size_t i = 0; i < found.transients.size(); ++i) {
    if (fit.experiments[i].follows_stress) continue;
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
                         .experiments = experiment_misfits(fit, found.fit.law),
                         .own = own_findings(EndochronicFindings{found.tried, found.rounds})};
  write_fit_json(results / "fit.json", report);
  return report.found;
}

}  // namespace pfdm
