#include "cases/program/studies/curve_fit.h"

#include "cases/program/session/head_line.h"
#include "cases/program/session/stopwatch.h"
#include "cases/program/studies/curve_fit_results.h"
#include "cases/program/studies/interval_trial.h"
#include "postproc/curves/curve_misfit.h"
#include "postproc/files/folder_lock.h"
#include "solver/calibration/profile_likelihood.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_change = 0.02;       // of chi^2: an eighth of a standard error is not worth more runs
constexpr double negligible_misfit = 1e-4;  // of the rms force: what load steps and tolerances leave

// Load steps make a curve uneven, and the differences of two curves more so: effects of two parameters that differ by
// less than this cannot be told apart.
constexpr double exactness = 0.01;

/// One fit, from its first run to its files.
class CurveFit {
 public:
  CurveFit(const CurveFitJob& job, Session& session)
      : job_(job),
        session_(session),
        runs_(session.results / "runs", session),
        parameters_(parameters_of(job.settings)),
        model_(job.file, parameters_, job.read_curve, runs_) {
    for (const CaseParameter& parameter : parameters_) first_.push_back(parameter.value);
    for (const CaseParameter& parameter : parameters_)
      is_of_set_up_.push_back(
          std::ranges::any_of(parameter.keys, [](const std::string& key) { return key.starts_with("experiment."); }));
    values_ = first_;
    is_estimated_.resize(values_.size(), false);
  }

  void run() {
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
                                 .runs = {runs_.n_made(), runs_.n_reused(), runs_.n_failed()},
                                 .seconds = watch.seconds()};
    write_curve_fit(job_, found, session_);
  }

 private:
  static std::vector<CaseParameter> parameters_of(const CurveFitSettings& settings) {
    std::vector<CaseParameter> result;
    for (const CurveFitParameter& parameter : settings.parameters) result.push_back(parameter.in_case);
    return result;
  }

  /// Where the stage cannot go on without an answer.
  SampledCurve curve_at(const std::vector<double>& values, std::optional<double> until) {
    auto curve = model_.respond(values, until);
    if (!curve) throw ComputationError(fmt::format("the run with {} does not converge", model_.shown(values)));
    return *curve;
  }

  /// All values, with those of the stage's parameters in their places.
  std::vector<double> with_stage(const CurveFitStage& stage, std::span<const double> of_stage) const {
    std::vector<double> values = values_;
    for (std::size_t k = 0; k < of_stage.size(); ++k) values[stage.parameters[k]] = of_stage[k];
    return values;
  }

  /// What the set-up adds to each specimen's curve with these values.
  std::vector<SetUp> set_ups_at(const std::vector<double>& values) const {
    if (std::ranges::count(is_of_set_up_, true) == 0) return job_.set_ups(job_.file);
    return job_.set_ups(with_values(job_.file, parameters_, values));
  }

  /// The least that the set-up may add, within the bounds.
  std::vector<SetUp> least_set_ups() const {
    std::vector<double> values = first_;
    for (std::size_t j = 0; j < values.size(); ++j)
      if (is_of_set_up_[j]) values[j] = job_.settings.parameters[j].in_fit.lower;
    return set_ups_at(values);
  }

  /// A computed curve as each specimen's record would show it.
  ModelCurves as_recorded_by_all(const SampledCurve& computed, const std::vector<double>& values) const {
    ModelCurves curves;
    for (const SetUp& set_up : set_ups_at(values)) curves.push_back(as_recorded(computed, set_up));
    return curves;
  }

  /// How far a stage's runs have to go: a smaller offset or compliance on trial needs more of the computed curve.
  std::optional<double> end_of_runs(const CurveFitStage& stage) const {
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

  /// The same ones with all values of the set-up: the computed curve reaches them with each.
  MeasuredPoints points_of(const CurveFitStage& stage, const SampledCurve& curve) {
    std::vector<double> latest;
    for (const SetUp& set_up : least_set_ups()) latest.push_back(as_recorded(curve, set_up).x.back());
    MeasuredPoints points = job_.settings.where.in_context(
        [&] { return points_between(job_.specimens, std::max(stage.from, curve.x.front()), stage.to, latest); });
    session_.log.say(fmt::format("stage \"{}\": {} parameters, {} measured points from {:.4g} to {:.4g} m", stage.name,
                                 stage.parameters.size(), points.points.size(),
                                 std::ranges::min(points.points, {}, &MeasuredPoints::Point::x).x,
                                 std::ranges::max(points.points, {}, &MeasuredPoints::Point::x).x));
    return points;
  }

  FitProblem problem_of(const CurveFitStage& stage, const MeasuredPoints& points, std::optional<double> until) {
    FitProblem problem;
    const bool all_estimated =
        std::ranges::all_of(stage.parameters, [this](std::size_t j) { return is_estimated_[j]; });
    for (const std::size_t j : stage.parameters) {
      FitParameter p = job_.settings.parameters[j].in_fit;
      p.start = std::clamp(values_[j], p.lower, p.upper);
      p.is_sampled = all_estimated || !is_estimated_[j];
      problem.parameters.push_back(p);
    }
    problem.noise_is_known = points.noise_is_known;
    problem.residuals = [this, &stage, &points, until](std::span<const double> values) {
      const std::vector<double> all = with_stage(stage, values);
      const auto curve = model_.respond(all, until);
      return curve ? residuals_of(as_recorded_by_all(*curve, all), points) : std::nullopt;
    };
    problem.prepare = [this, &stage, until](const std::vector<std::vector<double>>& all) {
      std::vector<std::vector<double>> full;
      full.reserve(all.size());
      for (const std::vector<double>& values : all) full.push_back(with_stage(stage, values));
      model_.prepare(full, until);
    };
    return problem;
  }

  FitStage fit_stage(const CurveFitStage& stage) {
    const std::optional<double> until = end_of_runs(stage);
    const SampledCurve first_curve = curve_at(first_, until);
    const MeasuredPoints points = points_of(stage, first_curve);
    const FitProblem problem = problem_of(stage, points, until);
    FitSettings settings = job_.settings.solver;
    settings.starts = stage.starts;
    settings.screened = stage.screened;
    settings.exactness = exactness;
    settings.cost_tolerance = least_change / static_cast<double>(points.points.size());
    settings.iterated = [&](const FitIteration& iteration) {
      session_.log.say(fmt::format("  rms residual {:.5g} at {}", iteration.rms,
                                   model_.shown(with_stage(stage, iteration.parameters))));
    };
    const FitResult result = fit(problem, settings);
    values_ = with_stage(stage, result.values());
    for (const std::size_t j : stage.parameters) is_estimated_[j] = true;
    FitStage found{.name = stage.name,
                   .from = points.points.front().x,
                   .to = points.points.back().x,
                   .found = findings_of(problem.parameters, result)};
    found.found.first_rms = rms_residual(as_recorded_by_all(first_curve, first_), points);
    const bool model_error = judge(found.found, {.series = series_of(points, result.residuals),
                                                 .negligible = negligible_misfit,
                                                 .misfit = points.noise_is_known ? 0.0 : result.rms});
    for (std::size_t k = 0; k < stage.parameters.size(); ++k)
      try_compliance(stage, k, problem, settings, result, found);
    const SampledCurve fitted = curve_at(values_, until);
    if (!(model_error && suspect_set_up(fitted, points, result, found))) suspect_origin(fitted, found);
    if (job_.settings.profiles && found.found.verdict == Verdict::sound)
      add_profiles(stage, problem, settings, result, found);
    return found;
  }

  /// One more reason where other parameters make up for a compliance of the set-up.
  void try_compliance(const CurveFitStage& stage, std::size_t k, const FitProblem& problem, const FitSettings& settings,
                      const FitResult& result, FitStage& found) const {
    const CaseParameter& parameter = parameters_[stage.parameters[k]];
    if (!is_of_set_up_[stage.parameters[k]] || parameter.dimension.name != dimension::compliance.name) return;
    std::vector<CaseParameter> of_stage;
    for (const std::size_t j : stage.parameters) of_stage.push_back(parameters_[j]);
    auto reason = doubt_of_interval({problem, settings, result, of_stage}, k, session_.log);
    if (reason) question(found, std::move(*reason));
  }

  /// Intervals by profile likelihood of the parameters that no later stage estimates anew.
  void add_profiles(const CurveFitStage& stage, const FitProblem& problem, const FitSettings& settings,
                    const FitResult& result, FitStage& found) const {
    for (std::size_t k = 0; k < stage.parameters.size(); ++k) {
      const CaseParameter& parameter = parameters_[stage.parameters[k]];
      if (&stage != &*last_stage_of(stage.parameters[k])) continue;
      const ProfileSettings how{.trying = [&](std::size_t, double value) {
        session_.log.say(fmt::format("  profile: {} = {}", parameter.short_name(), parameter.shown(value)));
      }};
      const ProfileInterval interval = profile_interval(problem, settings, result, k, how);
      if (interval.better)
        return question(found,
                        fmt::format("the fit has ended beside the lowest residuals: they are smaller with {} = {}; "
                                    "more starts may find them",
                                    parameter.name, parameter.shown(interval.better->value)));
      found.found.parameters[k].profile = FittedProfile{.lower = interval.lower_95,
                                                        .upper = interval.upper_95,
                                                        .lower_open = interval.lower_open,
                                                        .upper_open = interval.upper_open};
    }
  }

  std::vector<CurveFitStage>::const_iterator last_stage_of(std::size_t parameter) const {
    const std::vector<CurveFitStage>& stages = job_.settings.stages;
    auto stage = stages.end() - 1;
    while (std::ranges::count(stage->parameters, parameter) == 0) --stage;
    return stage;
  }

  static void question(FitStage& found, std::string reason) {
    found.found.reasons.push_back(std::move(reason));
    found.found.verdict = std::max(found.found.verdict, Verdict::questionable);
    withhold_intervals(found.found);
  }

  /// Where an imperfect set-up would explain most of what the model leaves, one more reason.
  bool suspect_set_up(const SampledCurve& fitted, const MeasuredPoints& points, const FitResult& result,
                      FitStage& found) const {
    const double left = rms_left_by(result.residuals, set_up_errors(as_recorded_by_all(fitted, values_), points));
    if (!(left < 0.5 * result.rms)) return false;
    found.found.reasons.push_back(fmt::format(
        "an offset of force or displacement, or the compliance of the set-up, would explain most of the "
        "residuals: with them their rms falls from {:.3g} to {:.3g}; correct the measured curve for them, or "
        "estimate them (offset, force_offset and compliance of [experiment])",
        result.rms, left));
    return true;
  }

  /// A straight part beside the computed one is a reason too, where the residuals are too few to show it.
  void suspect_origin(const SampledCurve& fitted, FitStage& found) const {
    const std::vector<SetUp> set_ups = set_ups_at(values_);
    for (std::size_t s = 0; s < job_.specimens.size(); ++s) {
      MeasuredCurve specimen = job_.specimens[s];
      specimen.set_up = set_ups[s];
      const auto missed = missed_origin(specimen.of_specimen(), fitted, job_.straight_from, job_.straight_to);
      if (!missed) continue;
      question(found, missed_origin_text(*missed, specimen.curve.name));
    }
  }

  /// The residuals of each specimen, over its displacement.
  std::vector<ResidualSeries> series_of(const MeasuredPoints& points, const std::vector<double>& residuals) const {
    std::vector<ResidualSeries> result;
    for (const MeasuredCurve& specimen : job_.specimens)
      result.push_back({.name = specimen.curve.name, .along = "displacement", .values = {}});
    for (std::size_t i = 0; i < residuals.size(); ++i) result[points.points[i].specimen].values.push_back(residuals[i]);
    return result;
  }

  const CurveFitJob& job_;
  Session& session_;
  CaseRuns runs_;
  std::vector<CaseParameter> parameters_;
  CurveModel model_;
  std::vector<double> first_;       // of all parameters, the case's own [SI]
  std::vector<double> values_;      // of all parameters, as known so far [SI]
  std::vector<bool> is_of_set_up_;  // parameters of the measured curves: no run depends on them
  std::vector<bool> is_estimated_;  // by an earlier stage
};

}  // namespace

void fit_curve(const CurveFitJob& job, Session& session) {
  require_start_within_bounds(job.settings.where, job.settings.parameters);
  const FolderLock lock(session.results);
  session.log.say(head_line(session, fmt::format("fit of {}: {}", job.name, job.title)));
  session.log.open_file(session.results / "fit.log", true);
  CurveFit(job, session).run();
}

}  // namespace pfdm
