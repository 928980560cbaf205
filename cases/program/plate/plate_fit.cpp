#include "cases/program/plate/plate_fit.h"

#include "cases/program/plate/plate_fit_model.h"
#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/json.h"
#include "postproc/fits/fit_judgement.h"
#include "postproc/fits/record_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<double> magnitudes(const std::vector<std::complex<double>>& H1) {
  std::vector<double> result;
  result.reserve(H1.size());
  for (const auto& H : H1) result.push_back(std::abs(H));
  return result;
}

std::vector<double> phases(const std::vector<std::complex<double>>& H1) {
  std::vector<double> result;
  result.reserve(H1.size());
  for (const auto& H : H1) result.push_back(std::arg(H));
  return result;
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

FitProblem problem_of(const PlateFit& fit, PlateModel& model) {
  FitProblem problem;
  for (const CurveFitParameter& parameter : fit.parameters) problem.parameters.push_back(parameter.in_fit);
  problem.noise_is_known = true;
  problem.residuals = model.remembered_residuals();
  return problem;
}

FitSettings settings_of(const PlateFit& fit, Session& session) {
  FitSettings settings;
  settings.maximum_iterations = 40;
  settings.step = 1e-3;
  settings.least_step = 1e-6;
  settings.trust_radius = 30.0;
  settings.exactness = 1e-4;
  settings.side_by_side = false;
  settings.starts = fit.starts;
  settings.iterated = [&](const FitIteration& iteration) {
    std::vector<CaseParameter> parameters;
    for (const CurveFitParameter& parameter : fit.parameters) parameters.push_back(parameter.in_case);
    session.log.say(fmt::format("  rms residual {:.5g} at {}", iteration.rms, shown(parameters, iteration.parameters)));
  };
  return settings;
}

/// Rms of the residuals of H1.
double rms_of_responses(const PlateFit& fit, const std::vector<double>& residuals) {
  std::size_t n = 0;
  for (const MeasuredResponse& measured : fit.responses) n += measured.magnitude.size() + measured.phase.size();
  return n == 0 ? 0.0 : rms({residuals.begin(), residuals.begin() + n});
}

/// What the residuals that are more than noise may come from, as reasons. Returns what was tried.
std::vector<FitSuspect> add_suspects(const PlateFit& fit, const FitResult& result, PlateModel& model,
                                     const FitSettings& settings, FitFindings& found) {
  constexpr double telling = 0.5, alike = 1.2;  // of the rms
  const double of_responses = rms_of_responses(fit, result.residuals);
  std::vector<FitSuspect> readings = suspected_readings(model, fit, settings);
  if (!readings.empty() && readings.front().rms < telling * of_responses) {
    question(found, fmt::format("the rms of the residuals of H1 falls from {:.3g} to {:.3g} if it is taken for {}",
                                of_responses, readings.front().rms, readings.front().what));
    return readings;
  }
  std::vector<FitSuspect> suspects = suspects_of(model, fit, result.values(), result.residuals);
  if (suspects.empty() || suspects.front().rms > telling * result.rms) {
    if (!is_sound(found.verdict))
      found.reasons.emplace_back(
          "nothing that was tried explains it: look at supports, dimensions and density, and at the mesh (finer of "
          "[fit])");
    return suspects;
  }
  for (const FitSuspect& suspect : suspects)
    if (suspect.rms <= alike * suspects.front().rms)
      question(found, fmt::format("the rms of the residuals would fall from {:.3g} to {:.3g} with {}", result.rms,
                                  suspect.rms, suspect.what));
  return suspects;
}

std::vector<FittedRecord> records_of(const PlateFit& fit) {
  std::vector<FittedRecord> records;
  const auto add = [&](const std::vector<double>& measured, double deviation, auto row) {
    FittedRecord& record = records.emplace_back(FittedRecord{.row = std::move(row)});
    for (const double value : measured) record.measured.push_back(value / deviation);
  };
  for (const MeasuredResponse& measured : fit.responses) {
    std::vector<double> logarithms;
    for (const double magnitude : measured.magnitude) logarithms.push_back(std::log(magnitude));
    const auto row = [&measured](const char* what, const std::vector<double>& values) {
      return [&measured, &values, what](std::size_t i) {
        return fmt::format("the row of {} with a {} of {:.4g} at {}", measured.name, what, values[i],
                           quantity_text(measured.frequency[i], "Hz"));
      };
    };
    add(logarithms, measured.deviation, row("magnitude", measured.magnitude));
    if (!measured.phase.empty()) add(measured.phase, measured.deviation, row("phase in radians", measured.phase));
  }
  for (const MeasuredRise& measured : fit.rises)
    add(measured.rise, measured.deviation, [&measured](std::size_t i) {
      return fmt::format("the row of {} with a rise of {} at {}", measured.name, quantity_text(measured.rise[i], "K"),
                         quantity_text(measured.time[i], "s"));
    });
  return records;
}

void write_curves(const fs::path& folder, const PlateFit& fit, const PlateCurves& first, const PlateCurves& fitted) {
  for (std::size_t k = 0; k < fit.responses.size(); ++k) {
    const MeasuredResponse& measured = fit.responses[k];
    CsvTable table;
    table.add("frequency_Hz", measured.frequency);
    table.add("measured_magnitude", measured.magnitude);
    table.add("first_magnitude", magnitudes(first.H1[k]));
    table.add("model_magnitude", magnitudes(fitted.H1[k]));
    if (!measured.phase.empty()) table.add("measured_phase_rad", measured.phase);
    table.add("model_phase_rad", phases(fitted.H1[k]));
    write_csv(folder / plate_fit_curve_file(measured.name), table);
  }
  for (std::size_t k = 0; k < fit.rises.size(); ++k) {
    CsvTable table;
    table.add("time_s", fit.rises[k].time);
    table.add("measured_rise_K", fit.rises[k].rise);
    table.add("first_rise_K", first.rise[k]);
    table.add("model_rise_K", fitted.rise[k]);
    write_csv(folder / plate_fit_curve_file(fit.rises[k].name), table);
  }
}

std::vector<ExperimentMisfit> misfits(const PlateFit& fit, const PlateCurves& fitted) {
  std::vector<ExperimentMisfit> all;
  for (std::size_t k = 0; k < fit.responses.size(); ++k) {
    const MeasuredResponse& measured = fit.responses[k];
    all.push_back({.name = measured.name,
                   .n_data = measured.magnitude.size() + measured.phase.size(),
                   .relative = rms(difference(magnitudes(fitted.H1[k]), measured.magnitude)) / rms(measured.magnitude),
                   .curve = plate_fit_curve_file(measured.name)});
  }
  for (std::size_t k = 0; k < fit.rises.size(); ++k) {
    const MeasuredRise& measured = fit.rises[k];
    all.push_back(experiment_misfit(measured.name, measured.rise.size(),
                                    {.rms = rms(difference(fitted.rise[k], measured.rise)),
                                     .rms_measured = rms(measured.rise),
                                     .quantity = "rise",
                                     .unit = "K"},
                                    plate_fit_curve_file(measured.name)));
  }
  return all;
}

void say(const PlateFit& fit, const FitReport& report, Log& log) {
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    const FittedParameter& p = report.found.parameters[j];
    const CaseParameter& in_case = fit.parameters[j].in_case;
    const double unit = in_case.unit_in_si;
    log.say(fmt::format("  {} = {}, {}{}", p.name, in_case.shown(p.estimate),
                        interval_text(p.lower / unit, p.upper / unit), moved_text(p)));
  }
  for (const ExperimentMisfit& e : report.experiments)
    log.say(fmt::format("rms difference from {}: {:.2f} % of its rms", e.name, 100.0 * e.relative));
}

std::vector<double> first_guess(const PlateFit& fit) {
  std::vector<double> values;
  for (const CurveFitParameter& parameter : fit.parameters) values.push_back(parameter.in_case.value);
  return values;
}

OwnFindings own_findings(const std::vector<FitSuspect>& suspects) {
  auto list = nlohmann::ordered_json::array();
  for (const FitSuspect& s : suspects) list.push_back({{"what", s.what}, {"rms_residual", s.rms}});
  return {.kind = "plate", .json = json_line(nlohmann::ordered_json{{"suspects", list}})};
}

void write_fitted_case(const PlateProgram& program, const std::vector<double>& values, const Session& session) {
  std::vector<CaseParameter> parameters;
  for (const CurveFitParameter& parameter : program.fit->parameters) parameters.push_back(parameter.in_case);
  write_file(session.results / "case.fitted.toml",
             fmt::format("# made by pfdm fit from the case {}: values that [[fit.parameters]] names are estimates\n",
                         program.name) +
                 moved(with_values(program.file, parameters, values), session.results));
}

}  // namespace

std::string plate_fit_curve_file(const std::string& name) { return fmt::format("fit_{}.csv", name); }

void fit_plate(const PlateProgram& program, Session& session) {
  const Stopwatch watch;
  const PlateFit& fit = *program.fit;
  require_start_within_bounds(fit.where, fit.parameters);
  const FolderLock lock(session.results);
  session.log.say(fmt::format("pfdm {}, fit of {}: {}", session.version, program.name, program.parsed.title));
  session.log.open_file(session.results / "fit.log", false);
  const Mesh mesh = program.parsed.mesh.make();
  PlateModel model(program.file, fit, program.parsed, mesh);
  const auto first = model.curves(program.parsed);
  if (!first) throw ComputationError("the case itself, from which the fit starts, has no resonance or no response");
  const FitProblem problem = problem_of(fit, model);
  const FitSettings settings = settings_of(fit, session);
  const FitResult result = pfdm::fit(problem, settings);
  const PlateCurves fitted = model.curves(model.with(result.values())).value();
  const std::vector<ExperimentMisfit> experiments = misfits(fit, fitted);
  FitFindings found = findings_of(problem.parameters, result);
  found.is_discretised = true;
  std::vector<FitSuspect> suspects;
  if (judge(found, {.series = model.series(result.residuals),
                    .result = &result,
                    .misfit = std::ranges::max(experiments, {}, &ExperimentMisfit::relative).relative,
                    .finer = on_finer_mesh(program.file, fit, result.values(), session.log)}))
    suspects = add_suspects(fit, result, model, settings, found);
  doubt_stray_row(result, records_of(fit), 0.0, found);
  FitReport report{.case_name = program.name,
                   .case_hash = program.hash,
                   .version = session.version,
                   .method = "response_and_temperature",
                   .found = std::move(found),
                   .experiments = experiments,
                   .own = own_findings(suspects)};
  report.wall_seconds = watch.seconds();
  if (const auto residuals = model.residuals(model.with(first_guess(fit)))) report.found.first_rms = rms(*residuals);
  write_curves(session.results, fit, *first, fitted);
  write_fitted_case(program, result.values(), session);
  write_fit_json(session.results / fit_file, report);
  say(fit, report, session.log);
  session.log.say(fmt::format("{} evaluations, {:.1f} s; {}; written to {}", result.evaluations, report.wall_seconds,
                              end_of_search(result.message), session.results.string()));
  say_verdict(report.found, session);
}

}  // namespace pfdm
