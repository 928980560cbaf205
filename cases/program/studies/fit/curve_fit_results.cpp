#include "cases/program/studies/fit/curve_fit_results.h"

#include "cases/program/session/fit_verdict.h"
#include "physics/quantity_text.h"
#include "postproc/curves/curve_misfit.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr const char* fitted_curve_file = "fit_curve.csv";

/// The worse of both verdicts, and the reasons of the earlier one.
void take_doubts(const FitStage& earlier, FitFindings& whole) {
  whole.verdict = std::max(whole.verdict, earlier.found.verdict);
  for (const std::string& reason : earlier.found.reasons) {
    std::string from = fmt::format("stage \"{}\": {}", earlier.name, reason);
    if (std::ranges::count(whole.reasons, from) == 0) whole.reasons.push_back(std::move(from));
  }
}

/// The last stage's result, to which the estimates of parameters that it left alone are added, from the last stage that
/// had them; their correlation with the others is not known.
FitFindings merged(const std::vector<FitStage>& stages) {
  FitFindings whole = stages.back().found;
  for (auto stage = stages.rbegin() + 1; stage != stages.rend(); ++stage)
    for (const FittedParameter& p : stage->found.parameters) {
      if (std::ranges::count(whole.parameters, p.name, &FittedParameter::name) > 0) continue;
      whole.parameters.push_back(p);
      take_doubts(*stage, whole);
      const Eigen::Index n = whole.correlation.rows();
      whole.correlation.conservativeResizeLike(Eigen::MatrixXd::Identity(n + 1, n + 1));
      whole.warnings.push_back(fmt::format(
          "{} was estimated in stage \"{}\"; the intervals of the others are conditional on it", p.name, stage->name));
    }
  if (!is_sound(whole.verdict)) withhold_intervals(whole);
  return whole;
}

/// Computed curves at the points of their comparison, with the first guess beside.
CsvTable curve_table(const CurveFitJob& job, const CurveFitFindings& found) {
  std::vector<SampledCurve> measured;
  for (const MeasuredCurve& specimen : found.specimens) measured.push_back(specimen.of_specimen());
  const ComparedCurves compared = compare_curves(found.fitted_curve, measured);
  CsvTable table;
  table.comments.push_back(
      fmt::format("fit of {}: force over displacement, measured (mean of {} specimens), computed "
                  "with the first guess and with the estimates",
                  job.name, found.specimens.size()));
  table.add("displacement_m", compared.x);
  table.add("measured_force_N", compared.measured);
  if (!compared.deviation.empty()) table.add("measured_deviation_force_N", compared.deviation);
  std::vector<double> first;
  for (const double x : compared.x) first.push_back(found.first_curve.at(x));
  table.add("first_force_N", std::move(first));
  table.add("model_force_N", compared.model);
  return table;
}

std::vector<ExperimentMisfit> misfits(const CurveFitFindings& found) {
  std::vector<ExperimentMisfit> result;
  const SampledCurve& computed = found.fitted_curve;
  for (const MeasuredCurve& specimen : found.specimens) {
    const SampledCurve model = as_recorded(computed, specimen.set_up);
    const MeasuredPoints points = points_between({specimen}, computed.x.front(), computed.x.back(), {model.x.back()});
    result.push_back(experiment_misfit(
        specimen.curve.name, points.points.size(),
        {.rms = rms_difference(model, points, 0), .rms_measured = points.rms, .quantity = "force", .unit = "N"},
        fitted_curve_file));
    result.back().preparation = specimen.treatment();
  }
  return result;
}

std::string profile_text(const CaseParameter& p, const FittedParameter& found) {
  if (!found.profile) return "";
  const std::string bound = " (the bound)";
  return fmt::format("; by profile likelihood between {}{}",
                     ends_text(p.in_file_units(found.profile->lower), p.in_file_units(found.profile->upper),
                               (found.profile->lower_open ? bound : "") + " and "),
                     found.profile->upper_open ? bound : "");
}

std::string posterior_text(const CaseParameter& p, const FittedParameter& found) {
  if (!found.posterior) return "";
  const double lower = p.in_file_units(found.posterior->lower), upper = p.in_file_units(found.posterior->upper);
  return fmt::format("; posterior: median {}, between {}",
                     value_text(p.in_file_units(found.posterior->median), lower, upper),
                     ends_text(lower, upper, " and "));
}

void say_discrepancy(const DiscrepancyFindings& found, Log& log) {
  const auto shown = [](const SampledInterval& i, const char* unit) {
    return fmt::format("{} ({} to {})", quantity_text(i.median, unit, 3), quantity_text(i.lower, unit, 3),
                       quantity_text(i.upper, unit, 3));
  };
  log.say(fmt::format("  discrepancy of the model in the posterior: {} over lengths of {}, in {}",
                      shown(found.amplitude, "N"), shown(found.length, "m"), found.file));
}

void say_estimates(const FitFindings& whole, const std::vector<CaseParameter>& parameters, Log& log) {
  log.say(fmt::format("rms residual of {} points {:.4g}, with the first guess {:.4g}", whole.n_residuals, whole.rms,
                      *whole.first_rms));
  for (const FittedParameter& found : whole.parameters) {
    const CaseParameter& p = *std::ranges::find(parameters, found.name, &CaseParameter::name);
    const double lower = p.in_file_units(found.lower), upper = p.in_file_units(found.upper);
    log.say(fmt::format("  {} = {} {}, {}{}{}{}, first guess {:.5g}", p.name,
                        value_text(p.in_file_units(found.estimate), lower, upper), p.unit, interval_text(lower, upper),
                        profile_text(p, found), posterior_text(p, found), moved_text(found),
                        p.in_file_units(found.first_guess)));
  }
  if (whole.posterior && whole.posterior->discrepancy) say_discrepancy(*whole.posterior->discrepancy, log);
  for (std::size_t j = 0; j < whole.parameters.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      log.say(fmt::format("  correlation of {} and {}: {:.3f}", whole.parameters[i].name, whole.parameters[j].name,
                          whole.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
}

void say_event(const FittedEvent& event, Log& log) {
  for (const FittedEvent::Figure& f : event.figures)
    if (std::isfinite(f.residual))
      log.say(fmt::format("{} of {}: {} {}, measured {}, {:+.2f} standard deviations{}", event.name, event.specimen,
                          in_words(f.name), quantity_text(f.computed, f.unit), quantity_text(f.measured, f.unit),
                          f.residual, event.is_there ? "" : " (it is not in the fitted curve)"));
}

void say_field(const FittedField& field, Log& log) {
  for (const FittedField::Frame& f : field.frames)
    log.say(fmt::format("field {}, frame {} at {}: rms difference {} of {}, {} places", field.name, f.name,
                        quantity_text(f.displacement, "m"), quantity_text(f.rms, "m", 3),
                        quantity_text(f.rms_measured, "m", 3), f.places));
  log.say(fmt::format(
      "field {}: its {} data count with a standard deviation of {} of a point{}", field.name, field.n_data,
      quantity_text(field.deviation, "m", 3),
      field.inflation > 1.0
          ? fmt::format(", {:.2g} times that of their scatter: they are correlated over {}{}", field.inflation,
                        quantity_text(field.over, "m", 2), field.over_frames ? " and frames" : "")
          : ""));
}

std::string counts_text(const RunCounts& runs) {
  return fmt::format("{} runs made, {} reused, {} of them did not converge", runs.made, runs.reused, runs.failed);
}

/// Those of what withheld intervals leave out are not written, and those of earlier fits go.
void write_tables(const std::map<std::string, CsvTable>& tables, const FitFindings& whole, const fs::path& results) {
  std::set<std::string> kept{whole.sensitivity_file};
  for (const auto& [file, table] : tables)
    if (file.starts_with(field_tables)) kept.insert(file);
  if (whole.posterior) {
    kept.insert(whole.posterior->file);
    kept.insert(whole.posterior->law_files.begin(), whole.posterior->law_files.end());
    if (const auto& discrepancy = whole.posterior->discrepancy) kept.insert(discrepancy->file);
  }
  for (const auto& [file, table] : tables)
    if (kept.contains(file)) write_csv(results / file, table);
  for (const fs::directory_entry& entry : fs::directory_iterator(results)) {
    const std::string file = entry.path().filename().string();
    const bool is_table = file == "fit_posterior.csv" || file == "fit_discrepancy.csv" ||
                          (file.starts_with("fit_law_") && file.ends_with(".csv")) ||
                          (file.starts_with(field_tables) && file.ends_with(".csv"));
    if (is_table && !kept.contains(file)) fs::remove(entry.path());
  }
}

}  // namespace

void write_curve_fit(const CurveFitJob& job, const CurveFitFindings& found, Session& session) {
  const fs::path& results = session.results;
  const FitReport report{
      .case_name = job.name,
      .case_hash = job.hash,
      .version = session.version,
      .method = "force_displacement",
      .wall_seconds = found.seconds,
      .found = merged(found.stages),
      .experiments = misfits(found),
      .events = found.events,
      .fields = found.fields,
      .own = own_findings(FractureFindings{.earlier_stages = {found.stages.begin(), found.stages.end() - 1},
                                           .runs = found.runs,
                                           .coarse_runs = found.coarse_runs})};
  write_csv(results / fitted_curve_file, curve_table(job, found));
  const CaseFile fitted = with_values(job.file, found.parameters, found.values);
  write_file(results / "case.fitted.toml",
             fmt::format("# made by pfdm fit from the case {}: values that [[fit.parameters]] names are estimates\n",
                         job.name) +
                 moved(fitted, results));
  write_tables(found.tables, report.found, results);
  write_fit_json(results / "fit.json", report);
  for (const ExperimentMisfit& e : report.experiments)
    for (const std::string& done : e.preparation) session.log.say(fmt::format("{}: {}", e.name, done));
  say_estimates(report.found, found.parameters, session.log);
  for (const ExperimentMisfit& e : report.experiments)
    session.log.say(fmt::format("rms difference from {}: {}, {:.2f} % of its rms force", e.name,
                                quantity_text(e.absolute->rms, "N"), 100.0 * e.relative));
  for (const FittedEvent& event : report.events) say_event(event, session.log);
  for (const FittedField& field : report.fields) say_field(field, session.log);
  session.log.say(fmt::format("{}{}; {:.1f} s; {}", counts_text(found.runs),
                              found.coarse_runs ? ", of the coarse case " + counts_text(*found.coarse_runs) : "",
                              found.seconds, end_of_search(report.found.message)));
  say_fitted_case(session);
  say_verdict(report.found, session);
}

}  // namespace pfdm
