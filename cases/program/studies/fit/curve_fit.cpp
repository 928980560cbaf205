#include "cases/program/studies/fit/curve_fit.h"

#include "cases/program/session/head_line.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "cases/program/studies/fit/curve_fit_results.h"
#include "cases/program/studies/fit/finer_case.h"
#include "physics/quantity_text.h"
#include "postproc/files/folder_lock.h"
#include "solver/calibration/manifold_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double least_change = 0.02;       // of chi^2: an eighth of a standard error is not worth more runs
constexpr double negligible_misfit = 1e-4;  // of the rms force: what load steps and tolerances leave
constexpr double most_of_noise = 0.05;      // likewise; correlated residuals above, of no stated noise, are the model's

// Load steps make a curve uneven, and the differences of two curves more so: effects of two parameters that differ by
// less than this cannot be told apart.
constexpr double exactness = 0.01;

// A first guess that is three to four times off leads to other minima, which leave much of the data.
constexpr double lost_misfit = 0.15;  // of the rms force
constexpr int points_a_parameter = 8, most_points = 16, descents = 2;
constexpr double reach_of_sample = 1.5;  // of the sample: a factor of 4.5

RunCounts counts_of(const CaseRuns& runs) { return {runs.n_made(), runs.n_reused(), runs.n_failed()}; }

void start_at(const std::vector<double>& values, FitProblem& problem) {
  for (std::size_t j = 0; j < values.size(); ++j) problem.parameters[j].start = values[j];
}

}  // namespace

CurveFit::CurveFit(const CurveFitJob& job, Session& session)
    : job_(job),
      session_(session),
      runs_(session.results / "runs", session),
      parameters_(parameters_of(job.settings)),
      model_(job.file, parameters_, job.read_curve, runs_),
      finer_(finer_case(job.settings.where, job.file)),
      coarse_(coarse_case(job.settings.where, job.file)),
      coarse_runs_(session.results / "coarse_runs", session) {
  const auto read_aligned = [this](const std::filesystem::path& results) {
    return alignment_(job_.read_curve(results));
  };
  if (coarse_) coarse_model_.emplace(coarse_->file, parameters_, read_aligned, coarse_runs_);
  for (const CaseParameter& parameter : parameters_) first_.push_back(parameter.value);
  for (const CaseParameter& parameter : parameters_)
    is_of_set_up_.push_back(
        std::ranges::any_of(parameter.keys, [](const std::string& key) { return key.starts_with("experiment."); }));
  values_ = first_;
  is_estimated_.resize(values_.size(), false);
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

std::vector<double> CurveFit::with_stage(const CurveFitStage& stage, std::span<const double> of_stage) const {
  std::vector<double> values = values_;
  for (std::size_t k = 0; k < of_stage.size(); ++k) values[stage.parameters[k]] = of_stage[k];
  return values;
}

std::vector<SetUp> CurveFit::set_ups_at(const std::vector<double>& values) const {
  if (std::ranges::count(is_of_set_up_, true) == 0) return job_.set_ups(job_.file);
  return job_.set_ups(with_values(job_.file, parameters_, values));
}

std::vector<SetUp> CurveFit::least_set_ups() const {
  std::vector<double> values = first_;
  for (std::size_t j = 0; j < values.size(); ++j)
    if (is_of_set_up_[j]) values[j] = job_.settings.parameters[j].in_fit.lower;
  return set_ups_at(values);
}

ModelCurves CurveFit::as_recorded_by_all(const SampledCurve& computed, const std::vector<double>& values) const {
  ModelCurves curves;
  for (const SetUp& set_up : set_ups_at(values)) curves.push_back(as_recorded(computed, set_up));
  return curves;
}

std::optional<double> CurveFit::end_of_runs(const CurveFitStage& stage) const {
  if (!std::isfinite(stage.to)) return std::nullopt;
  const std::vector<SetUp> least = least_set_ups();
  double more = 0.0;
  for (std::size_t s = 0; s < job_.specimens.size(); ++s) {
    const MeasuredCurve& specimen = job_.specimens[s];
    more = std::max(
        more, specimen.set_up.offset - least[s].offset +
                  (specimen.set_up.compliance - least[s].compliance) * std::ranges::max(specimen.of_specimen().y));
  }
  return stage.to + more;
}

MeasuredPoints CurveFit::points_of(const CurveFitStage& stage, const SampledCurve& curve) {
  std::vector<double> latest;
  for (const SetUp& set_up : least_set_ups()) latest.push_back(as_recorded(curve, set_up).x.back());
  MeasuredPoints points = job_.settings.where.in_context(
      [&] { return points_between(job_.specimens, std::max(stage.from, curve.x.front()), stage.to, latest); });
  session_.log.say(fmt::format("stage \"{}\": {} parameters, {} measured points from {}", stage.name,
                               stage.parameters.size(), points.points.size(),
                               quantities_text({std::ranges::min(points.points, {}, &MeasuredPoints::Point::x).x,
                                                std::ranges::max(points.points, {}, &MeasuredPoints::Point::x).x},
                                               "m", " to ")));
  return points;
}

FitProblem CurveFit::problem_of(const CurveFitStage& stage, const MeasuredPoints& points, std::optional<double> until,
                                CurveModel& model) {
  FitProblem problem;
  const bool all_estimated = std::ranges::all_of(stage.parameters, [this](std::size_t j) { return is_estimated_[j]; });
  for (const std::size_t j : stage.parameters) {
    FitParameter p = job_.settings.parameters[j].in_fit;
    p.start = std::clamp(values_[j], p.lower, p.upper);
    p.is_sampled = all_estimated || !is_estimated_[j];
    problem.parameters.push_back(p);
  }
  problem.noise_is_known = points.noise_is_known;
  const auto residuals_by = [this, &stage, &points, &model, until](auto compared) {
    return [=, this, &stage, &points, &model](std::span<const double> values) {
      const std::vector<double> all = with_stage(stage, values);
      const auto curve = model.respond(all, until);
      return curve ? compared(as_recorded_by_all(*curve, all), points) : std::nullopt;
    };
  };
  problem.residuals = residuals_by(
      [](const ModelCurves& curves, const MeasuredPoints& measured) { return residuals_of(curves, measured); });
  problem.averaged = residuals_by(averaged_residuals_of);
  problem.prepare = [this, &stage, &model, until](const std::vector<std::vector<double>>& all) {
    std::vector<std::vector<double>> full;
    full.reserve(all.size());
    for (const std::vector<double>& values : all) full.push_back(with_stage(stage, values));
    model.prepare(full, until);
  };
  return problem;
}

FitSettings CurveFit::settings_of(const CurveFitStage& stage, const MeasuredPoints& points) {
  FitSettings settings = job_.settings.solver;
  settings.starts = stage.starts;
  settings.screened = stage.screened;
  settings.exactness = exactness;
  settings.cost_tolerance = least_change / static_cast<double>(points.points.size());
  settings.iterated = [this, &stage](const FitIteration& iteration) {
    session_.log.say(fmt::format("  rms residual {:.5g} at {}", iteration.rms,
                                 model_.shown(with_stage(stage, iteration.parameters))));
  };
  return settings;
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
  coarse.fitted = fit_model(coarse.problem, points, settings);
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
  if (rough) alignment_ = JumpAlignment(*rough, curve_at(values, until));
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
  } catch (const ComputationError&) {
    return false;
  }
}

bool CurveFit::judge_stage(const DoneStage& done, FitFindings& found) {
  const double misfit = relative_misfit(done.result.residuals, done.points);
  return judge(found, {.series = series_of(done.points, done.result.residuals),
                       .result = &done.result,
                       .correlated_is_noise = done.points.noise_is_known || misfit < most_of_noise,
                       .negligible = negligible_misfit,
                       .misfit = misfit,
                       .finer = on_finer_model(done)});
}

FitStage CurveFit::fit_stage(const CurveFitStage& stage) {
  const std::optional<double> until = end_of_runs(stage);
  const SampledCurve first_curve = curve_at(first_, until);
  MeasuredPoints points = points_of(stage, first_curve);
  const FitSettings settings = settings_of(stage, points);
  FittedPoints fitted = fit_points(stage, points, until, settings, problem_of(stage, points, until, model_));
  weigh_specimens(stage, until, settings, points, fitted);
  const auto& [result, problem] = fitted;
  values_ = with_stage(stage, result.values());
  for (const std::size_t j : stage.parameters) is_estimated_[j] = true;
  FitStage found{.name = stage.name,
                 .from = points.points.front().x,
                 .to = points.points.back().x,
                 .found = findings_of(problem.parameters, result)};
  found.found.first_rms = rms_residual(as_recorded_by_all(first_curve, first_), points);
  const DoneStage done{stage, points, problem, settings, result, until};
  const bool model_error = judge_stage(done, found.found);
  doubt(done, model_error, found.found);
  const bool is_last = &stage == &job_.settings.stages.back();
  if (is_last) found.found.sensitivity_file = add_sensitivity(done, found.found);
  are_sound_ = are_sound_ && is_sound(found.found.verdict);
  if (are_sound_) try {
      if (job_.settings.intervals == Intervals::profile) add_profiles(done, found.found);
      if (job_.settings.intervals == Intervals::posterior && is_last) add_posterior(done, found.found);
    } catch (const NoConvergence& error) {
      found.found.warnings.push_back(fmt::format("without a posterior: {}", error.what()));
    }
  return found;
}

std::vector<CurveFitStage>::const_iterator CurveFit::last_stage_of(std::size_t parameter) const {
  const std::vector<CurveFitStage>& stages = job_.settings.stages;
  auto stage = stages.end() - 1;
  while (std::ranges::count(stage->parameters, parameter) == 0) --stage;
  return stage;
}

void fit_curve(const CurveFitJob& job, Session& session) {
  require_start_within_bounds(job.settings.where, job.settings.parameters);
  const FolderLock lock(session.results);
  session.log.say(head_line(session, fmt::format("fit of {}: {}", job.name, job.title)));
  session.log.open_file(session.results / "fit.log", true);
  CurveFit(job, session).run();
}

}  // namespace pfdm
