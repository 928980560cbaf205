#include "cases/program/viscoelastic/viscoelastic_fit_results.h"

#include "cases/program/input/laws/prony_reader.h"
#include "cases/program/studies/fit/material_tests.h"
#include "cases/program/viscoelastic/viscoelastic_fit_band.h"
#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/unit_key.h"
#include "postproc/fits/fit_judgement.h"
#include "postproc/fits/record_doubts.h"
#include "postproc/point/viscoelastic_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double negligible_residual = 0.01;  // over the noise
constexpr double most_of_noise = 0.05;        // of the data; correlated residuals above are an error of the law

/// "loss_modulus_Pa"
std::string column_of(MeasuredQuantity quantity) {
  std::string name(name_of(quantity));
  std::ranges::replace(name, ' ', '_');
  return key_with_unit(name, std::string(unit_of(quantity)));
}

std::vector<double> in_hertz(std::vector<double> angular_frequencies) {
  for (double& f : angular_frequencies) f /= 2.0 * std::numbers::pi;
  return angular_frequencies;
}

CsvTable fitted_curve(const ViscoelasticExperiment& measured, const PronyLaw& law) {
  const bool is_master = measured.is_frequency_sweep() && measured.temperatures.size() > 1;
  ViscoelasticExperiment test = measured;
  if (is_master) sort_rows(test, at_reference(measured, law.shift).angular_frequencies);
  CsvTable table;
  table.comments.push_back(
      fmt::format("test {}, {}: measured, and by the fitted law", test.name, name_of(test.deformation)));
  if (test.is_frequency_sweep()) {
    table.add("frequency_Hz", in_hertz(test.angular_frequencies));
    if (is_master) {
      table.add("temperature_K", test.temperatures);
      table.add("reduced_frequency_Hz", in_hertz(at_reference(test, law.shift).angular_frequencies));
    }
  } else {
    table.add("time_s", test.times);
    table.add(test.follows_stress ? "stress_Pa" : "strain", test.followed);
  }
  const auto fitted = respond(law, test);
  for (std::size_t c = 0; c < test.channels.size(); ++c) {
    const std::string name = column_of(test.channels[c].quantity);
    table.add("measured_" + name, test.channels[c].values);
    table.add("fitted_" + name, fitted[c]);
  }
  return table;
}

std::vector<ResidualSeries> series_of_tests(const ViscoelasticFitCase& fit, const std::vector<double>& residuals) {
  std::vector<ResidualSeries> result;
  auto at = residuals.begin();
  for (const ViscoelasticExperiment& test : fit.experiments)
    for (const ViscoelasticExperiment::Channel& channel : test.channels) {
      const auto end = at + std::ssize(channel.values);
      result.push_back({.name = fmt::format("{}, {}", test.name, name_of(channel.quantity)),
                        .along = test.is_frequency_sweep() ? "frequency" : "time",
                        .values = {at, end}});
      at = end;
    }
  return result;
}

std::string place_of_row(const ViscoelasticExperiment& test, std::size_t i) {
  if (!test.is_frequency_sweep()) return quantity_text(test.times[i], "s", 4);
  return quantity_text(test.angular_frequencies[i] / (2.0 * std::numbers::pi), "Hz", 4);
}

std::vector<FittedRecord> records_of_tests(const ViscoelasticFitCase& fit, const ViscoelasticIdentification& found) {
  std::vector<FittedRecord> records;
  const double* deviations = found.deviations.data();  // of all rows of all columns
  for (const ViscoelasticExperiment& test : fit.experiments) {
    const auto answered = respond(found.fit.law, test);
    for (std::size_t c = 0; c < test.channels.size(); ++c) {
      const ViscoelasticExperiment::Channel& channel = test.channels[c];
      records.push_back(record_of({.test = test.name,
                                   .quantity = name_of(channel.quantity),
                                   .unit = unit_of(channel.quantity),
                                   .measured = channel.values,
                                   .answered = answered[c],
                                   .usual = rms_of(channel.values),
                                   .deviation = [deviations](std::size_t i) { return deviations[i]; },
                                   .at = [&test](std::size_t i) { return place_of_row(test, i); }}));
      deviations += channel.values.size();
    }
  }
  return records;
}

/// The fit began elsewhere where it chose the branches, and did not begin at its last refinement.
void set_first_guess(const ViscoelasticFitCase& fit, FitFindings& findings) {
  for (FittedParameter& p : findings.parameters) p.first_guess = std::nan("");
  if (fit.settings.least_branches > 0) return;
  const std::vector<FitParameter> first = fit_parameters(fit.first, fit.settings.choice, {});
  for (FittedParameter& p : findings.parameters)
    for (const FitParameter& guess : first)
      if (guess.name == p.name) p.first_guess = guess.first;
}

/// Of a relaxed modulus that has been estimated as nothing beside the branches.
std::optional<std::string> doubt_of_flow(const ViscoelasticFit& fit) {
  constexpr double nothing = 1e-6;
  if (std::ranges::count(fit.parameters, "young_modulus", &FitParameter::name) == 0) return std::nullopt;
  double branches = 0.0;
  for (const auto& branch : fit.law.shear) branches += branch.modulus;
  if (!(fit.law.relaxed.mu < nothing * branches)) return std::nullopt;
  return "the relaxed modulus is zero as far as the tests tell: the material flows, or relaxes on after the longest of "
         "them; with estimate = [\"shear_branches\"] of [fit] the young_modulus of [material], a small one, is kept";
}

FitFindings judged_tests(const ViscoelasticFitCase& fit, const ViscoelasticIdentification& found) {
  FitFindings findings = findings_of(found.fit.parameters, found.fit.result);
  set_first_guess(fit, findings);
  const double misfit = relative_misfit(found.fit.law, fit.experiments);
  const bool model_error = judge(findings, {.series = series_of_tests(fit, found.fit.result.residuals),
                                            .result = &found.fit.result,
                                            .correlated_is_noise = misfit < most_of_noise,
                                            .negligible = negligible_residual,
                                            .misfit = misfit,
                                            .reasons = found.doubts});
  if (model_error && !is_sound(findings.verdict))
    findings.reasons.push_back(
        fmt::format("a Prony series of {} shear branch{}, the same in all tests, is the wrong model for these data, "
                    "which it misses by up to {:.2g} %{}",
                    found.fit.law.shear.size(), found.fit.law.shear.size() == 1 ? "" : "es", 100.0 * misfit,
                    found.fit.law.shift ? "; it shifts times alone: no moduli, and all processes by one law"
                                        : "; tests at several temperatures need a temperature_shift"));
  if (const auto flow = doubt_of_flow(found.fit)) question(findings, *flow);
  const std::vector<FittedRecord> records = records_of_tests(fit, found);
  doubt_stray_row(found.fit.result, records, negligible_residual, findings);
  widen_for_uneven_scatter(found.fit.result, records, negligible_residual,
                           "a relative_noise, stated, makes the estimates exacter where noise is a part of the value",
                           findings);
  return findings;
}

ExperimentMisfit misfit_of(const ViscoelasticExperiment& test, const PronyLaw& law) {
  const std::vector<double> parts = relative_misfits(law, test);
  ExperimentMisfit misfit{
      .name = test.name, .n_data = n_measured({test}), .relative = rms_of(parts), .curve = fit_curve_file(test.name)};
  if (test.is_frequency_sweep()) return misfit;
  const double rms = rms_of(test.channels[0].values);
  misfit.absolute = {.rms = parts[0] * rms,
                     .rms_measured = rms,
                     .quantity = std::string(name_of(test.channels[0].quantity)),
                     .unit = std::string(unit_of(test.channels[0].quantity))};
  return misfit;
}

}  // namespace

FitFindings write_fit_results(const std::filesystem::path& results, const CaseFile& file,
                              const ViscoelasticFitCase& fit, const ViscoelasticIdentification& found,
                              const FitRun& run) {
  const ViscoelasticExperiments there = at_reference(fit.experiments, found.fit.law.shift);
  FitReport report{.case_name = run.case_name,
                   .case_hash = run.case_hash,
                   .version = run.version,
                   .method = fit.settings.choice.times ? "least squares" : "least squares, fixed times",
                   .wall_seconds = run.wall_seconds,
                   .found = judged_tests(fit, found),
                   .experiments = {},
                   .own = own_findings(ViscoelasticFindings{found.tried, time_window(there)})};
  for (const ViscoelasticExperiment& test : fit.experiments) {
    write_csv(results / fit_curve_file(test.name), fitted_curve(test, found.fit.law));
    report.experiments.push_back(misfit_of(test, found.fit.law));
  }
  const ModulusBand band = modulus_band(found.fit, report.found, there, found.deviations);
  write_csv(results / modulus_band_file, band.table);
  if (!band.warning.empty()) report.found.warnings.push_back(band.warning);
  widen_relaxed_modulus(found.fit, there, found.deviations, report.found);
  write_file(
      results / "case.fitted.toml",
      with_table(file, "material", "# estimated by pfdm fit\n[material]\n" + to_toml(found.fit.law) + "\n", results));
  write_fit_json(results / "fit.json", report);
  return report.found;
}

}  // namespace pfdm
