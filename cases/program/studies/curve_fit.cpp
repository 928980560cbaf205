#include "cases/program/studies/curve_fit.h"

#include "cases/program/session/stopwatch.h"
#include "cases/program/studies/curve_fit_results.h"
#include "postproc/curves/curve_misfit.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_change = 0.02;       // of chi^2: an eighth of a standard error is not worth more runs
constexpr double negligible_misfit = 1e-4;  // of the rms force: what load steps and tolerances leave

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
    values_ = first_;
    is_estimated_.resize(values_.size(), false);
  }

  void run() {
    const Stopwatch watch;
    std::vector<FitStage> stages;
    for (const CurveFitStage& stage : job_.settings.stages) stages.push_back(fit_stage(stage));
    const SampledCurve fitted = curve_at(values_, std::nullopt);
    const CurveFitFindings found{.values = values_,
                                 .stages = std::move(stages),
                                 .parameters = parameters_,
                                 .first_curve = curve_at(first_, std::nullopt),
                                 .fitted_curve = fitted,
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

  MeasuredPoints points_of(const CurveFitStage& stage, const SampledCurve& curve) {
    MeasuredPoints points = job_.settings.where.in_context([&] {
      return points_between(job_.specimens, std::max(stage.from, curve.x.front()), std::min(stage.to, curve.x.back()));
    });
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
      const auto curve = model_.respond(with_stage(stage, values), until);
      return curve ? residuals_of(*curve, points) : std::nullopt;
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
    const auto until = std::isfinite(stage.to) ? std::optional(stage.to) : std::nullopt;
    const SampledCurve first_curve = curve_at(first_, until);
    const MeasuredPoints points = points_of(stage, first_curve);
    const FitProblem problem = problem_of(stage, points, until);
    FitSettings settings = job_.settings.solver;
    settings.starts = stage.starts;
    settings.screened = stage.screened;
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
    found.found.first_rms = rms_residual(first_curve, points);
    const bool model_error = judge(found.found, {.series = series_of(points, result.residuals),
                                                 .negligible = negligible_misfit,
                                                 .misfit = points.noise_is_known ? 0.0 : result.rms});
    if (model_error) suspect_set_up(curve_at(values_, until), points, result, found);
    return found;
  }

  /// Where an imperfect set-up would explain most of what the model leaves, one more reason.
  static void suspect_set_up(const SampledCurve& fitted, const MeasuredPoints& points, const FitResult& result,
                             FitStage& found) {
    const double left = rms_left_by(result.residuals, set_up_errors(fitted, points));
    if (!(left < 0.5 * result.rms)) return;
    found.found.reasons.push_back(
        fmt::format("an offset of force or displacement, or the compliance of the set-up, would explain most of the "
                    "residuals: with them their rms falls from {:.3g} to {:.3g}; correct the measured curve for them",
                    result.rms, left));
  }

  /// The residuals of each specimen, over its displacement.
  std::vector<ResidualSeries> series_of(const MeasuredPoints& points, const std::vector<double>& residuals) const {
    std::vector<ResidualSeries> result;
    for (const SampledCurve& specimen : job_.specimens)
      result.push_back({.name = specimen.name, .along = "displacement", .values = {}});
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
  std::vector<bool> is_estimated_;  // by an earlier stage
};

}  // namespace

void fit_curve(const CurveFitJob& job, Session& session) {
  require_start_within_bounds(job.settings);
  const FolderLock lock(session.results);
  session.log.say(
      fmt::format("pfdm {}, fit of {}: {}; {} threads", session.version, job.name, job.title, session.threads));
  session.log.open_file(session.results / "fit.log", true);
  CurveFit(job, session).run();
}

}  // namespace pfdm
