#include "cases/program/studies/fit/curve_fit.h"

#include "cases/program/session/head_line.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "cases/program/studies/fit/curve_fit_results.h"
#include "cases/program/studies/runs/finer_case.h"
#include "postproc/curves/record_faults.h"
#include "postproc/files/folder_lock.h"
#include "solver/calibration/manifold_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

namespace pfdm {
namespace {

constexpr double negligible_misfit = 1e-4;  // of the rms force: what load steps and tolerances leave
constexpr double most_of_noise = 0.05;      // likewise; correlated residuals above, of no stated noise, are the model's

// A first guess that is three to four times off leads to other minima, which leave much of the data.
constexpr double lost_misfit = 0.15;  // of the rms force
constexpr int points_a_parameter = 8, most_points = 16, descents = 2;
constexpr double reach_of_sample = 1.5;  // of the sample: a factor of 4.5

RunCounts counts_of(const CaseRuns& runs) { return {runs.n_made(), runs.n_reused(), runs.n_failed()}; }

/// By which curves of the coarse case are aligned: the least of the jumps that are events.
double least_fall_of(const std::vector<MeasuredEvent>& events) {
  std::optional<double> least;
  for (const MeasuredEvent& event : events)
    if (event.kind == EventKind::jump) least = std::min(least.value_or(event.least_fall), event.least_fall);
  return least.value_or(fall_of_jump);
}

void start_at(const std::vector<double>& values, FitProblem& problem) {
  for (std::size_t j = 0; j < values.size(); ++j) problem.parameters[j].start = values[j];
}

}  // namespace

CurveFit::CurveFit(const CurveFitJob& job, Session& session)
    : job_(job),
      session_(session),
      runs_(session.results / "runs", session),
      parameters_(parameters_of(job.settings)),
      model_(job.file, parameters_, job.read_curve, job.read_history, runs_),
      finer_(finer_case(job.settings.where, job.file)),
      coarse_(coarse_case(job.settings.where, job.file)),
      coarse_runs_(session.results / "coarse_runs", session) {
  const auto read_aligned = [this](const std::filesystem::path& results) {
    return alignment_(job_.read_curve(results));
  };
  if (coarse_) coarse_model_.emplace(coarse_->file, parameters_, read_aligned, job.read_history, coarse_runs_);
  runs_.record(job.fields.places);
  coarse_runs_.record(job.fields.places);
  fields_.resize(job.fields.fields.size());
  for (const CaseParameter& parameter : parameters_) first_.push_back(parameter.value);
  for (const CaseParameter& parameter : parameters_)
    is_of_set_up_.push_back(
        std::ranges::any_of(parameter.keys, [](const std::string& key) { return key.starts_with("experiment."); }));
  values_ = first_;
  events_ = job_.events;
  is_estimated_.resize(values_.size(), false);
  is_doubtful_.resize(values_.size(), false);
}

void CurveFit::run() {
  const Stopwatch watch;
  std::vector<FitStage> stages;
  for (const CurveFitStage& stage : job_.settings.stages) stages.push_back(fit_stage(stage));
  const SampledCurve fitted = curve_at(values_, std::nullopt);
  std::vector<MeasuredCurve> specimens = job_.specimens;
  const std::vector<SetUp> set_ups = set_ups_at(values_);
  for (std::size_t s = 0; s < specimens.size(); ++s) specimens[s].set_up = set_ups[s];
  const CurveFitFindings found{.values = values_,
                               .stages = std::move(stages),
                               .parameters = parameters_,
                               .first_curve = curve_at(first_, std::nullopt),
                               .fitted_curve = fitted,
                               .specimens = specimens,
                               .runs = counts_of(runs_),
                               .tables = tables_,
                               .events = fitted_events(fitted),
                               .fields = fitted_fields(),
                               .coarse_runs = coarse_ ? std::optional(counts_of(coarse_runs_)) : std::nullopt,
                               .seconds = watch.seconds()};
  write_curve_fit(job_, found, session_);
}

std::vector<CaseParameter> CurveFit::parameters_of(const CurveFitSettings& settings) {
  std::vector<CaseParameter> result;
  for (const CurveFitParameter& parameter : settings.parameters) result.push_back(parameter.in_case);
  return result;
}

SampledCurve CurveFit::curve_at(const std::vector<double>& values, std::optional<double> until) {
  auto curve = model_.respond(values, until);
  if (!curve) throw ComputationError(fmt::format("the run with {} does not converge", model_.shown(values)));
  return *curve;
}

FitResult CurveFit::fit_model(const FitProblem& problem, const MeasuredPoints& points, const FitSettings& settings) {
  FitResult result = fit(problem, settings);
  screen(problem, settings, relative_misfit(result.residuals, points), result);
  return result;
}

CurveFit::FittedPoints CurveFit::fit_points(const CurveFitStage& stage, const MeasuredPoints& points,
                                            std::optional<double> until, const FitSettings& settings,
                                            const FitProblem& problem) {
  if (!coarse_) return {fit_model(problem, points, settings), problem};
  session_.log.say(fmt::format("  with {}", coarse_->shown));
  CoarseModel coarse{.problem = problem_of(stage, points, until, *coarse_model_),
                     .meet = [&](std::span<const double> values) { align(with_stage(stage, values), until); }};
  coarse.problem.parameters = problem.parameters;
  alignment_ = {};
  coarse.fitted = fit_model(coarse.problem, points, on_grid(settings));
  session_.log.say("  the case itself where these lead");
  MappedFit mapped = fit_by_mapping(problem, coarse, settings);
  if (mapped.failure.empty()) return {std::move(mapped.result), std::move(mapped.mapped)};
  session_.log.warn(fmt::format("[fit] coarse does not lead to the estimates: {}; the case itself is run at every step",
                                mapped.failure));
  if (mapped.best.empty()) return {fit_model(problem, points, settings), problem};
  FitProblem from_best = problem;
  start_at(mapped.best, from_best);
  return {fit(from_best, from_one_start(settings)), problem};
}

void CurveFit::align(const std::vector<double>& values, std::optional<double> until) {
  alignment_ = {};
  const auto rough = coarse_model_->respond(values, until);
  if (rough) alignment_ = JumpAlignment(*rough, curve_at(values, until), least_fall_of(job_.events));
}

void CurveFit::weigh_specimens(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                               MeasuredPoints& points, FittedPoints& fitted) {
  if (points.noise_is_known) return;
  FitProblem problem = problem_of(stage, points, until, model_);
  for (int turn = 0; turn < 2; ++turn) {
    std::vector<double> weights = weights_by_scatter(fitted.result.residuals, points);
    if (weights.empty()) return;
    points.weight = std::move(weights);
    session_.log.say("  the specimens scatter differently: each is weighted by its own scatter");
    start_at(fitted.result.values(), problem);
    fitted = fit_points(stage, points, until, from_one_start(settings), problem);
  }
}

void CurveFit::widen_by_estimates(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                                  MeasuredPoints& points, FittedPoints& fitted) {
  constexpr int most_turns = 2;
  const SampledCurve first_curve = curve_at(first_, until);
  for (int turn = 0; turn < most_turns; ++turn) {
    const std::vector<double> estimates = fitted.result.values();
    std::vector<MeasuredEvent> events = widened_events(stage, with_stage(stage, estimates), until);
    if (std::ranges::equal(events, events_, is_as_exact)) return;
    session_.log.say("  again, for the load steps about the events are others with the estimates");
    events_ = std::move(events);
    points = points_of(stage, first_curve);
    say(stage, points);
    FitProblem problem = problem_of(stage, points, until, model_);
    start_at(estimates, problem);
    fitted = fit_points(stage, points, until, from_one_start(settings), problem);
  }
}

bool CurveFit::screen(const FitProblem& problem, const FitSettings& settings, double misfit, FitResult& result) {
  const bool is_noise = result.noise_is_known ? result.rms < 1.1 : whiteness(result.residuals).inflation < 1.25;
  if (settings.starts > 1 || settings.screened > 0 || !(misfit > lost_misfit) || is_noise) return false;
  FitSettings wide = settings;
  wide.screened = std::min(points_a_parameter * static_cast<int>(problem.parameters.size()), most_points);
  wide.starts = descents;
  wide.spread = std::max(settings.spread, reach_of_sample);
  session_.log.say(fmt::format("  the fit leaves {:.2g} % of the force: {} points about the first guess are tried",
                               100.0 * misfit, wide.screened));
  try {
    FitResult other = fit(problem, wide);
    if (!(other.rms < result.rms)) return false;
    result = std::move(other);
    return true;
  } catch (const NoConvergence&) {
    return false;
  }
}

bool CurveFit::judge_stage(const DoneStage& done, FitFindings& found) {
  found.is_discretised = true;
  const double misfit = relative_misfit(done.result.residuals, done.points);
  return judge(found, {.series = series_of(done.points, done.result.residuals),
                       .n_elsewhere = n_field_data(),
                       .result = &done.result,
                       .correlated_is_noise = done.points.noise_is_known || misfit < most_of_noise,
                       .negligible = negligible_misfit,
                       .misfit = misfit,
                       .finer = on_finer_model(done)});
}

void CurveFit::check_forces(const MeasuredPoints& points, const SampledCurve& first_curve) {
  const ModelCurves models = as_recorded_by_all(first_curve, first_, std::nullopt);
  job_.settings.where.in_context([&] { require_same_sign(models, points, job_.specimens); });
  for (const std::string& doubt : doubts_of_unit(models, points, job_.specimens)) session_.log.warn(doubt);
}

FitStage CurveFit::fit_stage(const CurveFitStage& stage) {
  const std::optional<double> until = end_of_runs(stage);
  const SampledCurve first_curve = curve_at(first_, until);
  events_ = widened_events(stage, values_, until);
  MeasuredPoints points = points_of(stage, first_curve);
  select_frames(stage, until, points);
  say(stage, points);
  check_forces(points, first_curve);
  const FitSettings settings = settings_of(stage, points);
  FittedPoints fitted = fit_points(stage, points, until, settings, problem_of(stage, points, until, model_));
  weigh_specimens(stage, until, settings, points, fitted);
  widen_by_estimates(stage, until, settings, points, fitted);
  weigh_fields(stage, until, settings, points, fitted);
  const auto& [result, problem] = fitted;
  values_ = with_stage(stage, result.values());
  for (const std::size_t j : stage.parameters) is_estimated_[j] = true;
  FitStage found{.name = stage.name,
                 .from = points.points.front().x,
                 .to = points.points.back().x,
                 .found = findings_of(problem.parameters, result)};
  const auto at_first = residuals_at(first_, until, points, model_, residuals_by_points);
  found.found.first_rms = at_first ? rms_left_by(*at_first, {}) : std::numeric_limits<double>::infinity();
  const DoneStage done{stage, points, problem, settings, result, until};
  const bool model_error = judge_stage(done, found.found);
  doubt(done, model_error, found.found);
  warn_of_steps(done, found.found);
  const bool is_last = &stage == &job_.settings.stages.back();
  if (is_last) found.found.sensitivity_file = add_sensitivity(done, found.found);
  add_other_intervals(done, found.found);
  for (const std::size_t j : stage.parameters) is_doubtful_[j] = !is_sound(found.found.verdict);
  return found;
}

void CurveFit::add_other_intervals(const DoneStage& done, FitFindings& found) {
  const Intervals wanted = job_.settings.intervals;
  const bool is_allowed =
      is_sound(found.verdict) || (wanted == Intervals::discrepancy && found.verdict == Verdict::questionable);
  if (!is_allowed || rests_on_doubts(done.stage)) return;
  const bool is_last = &done.stage == &job_.settings.stages.back();
  try {
    if (wanted == Intervals::profile) add_profiles(done, found);
    if (has_posterior(wanted) && is_last) add_posterior(done, found);
  } catch (const NoConvergence& error) {
    found.warnings.push_back(
        fmt::format("without {}: {}", wanted == Intervals::profile ? "profiles" : "a posterior", error.what()));
  }
}

bool CurveFit::rests_on_doubts(const CurveFitStage& stage) const {
  for (std::size_t j = 0; j < is_doubtful_.size(); ++j)
    if (is_doubtful_[j] && &*last_stage_of(j) < &stage) return true;
  return false;
}

std::vector<CurveFitStage>::const_iterator CurveFit::last_stage_of(std::size_t parameter) const {
  const std::vector<CurveFitStage>& stages = job_.settings.stages;
  auto stage = stages.end() - 1;
  while (std::ranges::count(stage->parameters, parameter) == 0) --stage;
  return stage;
}

void fit_curve(const CurveFitJob& job, Session& session) {
  require_start_within_bounds(job.settings.where, job.settings.parameters);
  require_in_a_stage(job.settings, job.specimens, job.events);
  const FolderLock lock(session.results);
  session.log.say(head_line(session, fmt::format("fit of {}: {}", job.name, job.title)));
  session.log.open_file(session.results / "fit.log", true);
  CurveFit(job, session).run();
}

}  // namespace pfdm
