// What a stage of a fit asks of the solver: member functions of curve_fit_at_work.h.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace pfdm {
namespace {

constexpr double least_change = 0.02;  // of chi^2: an eighth of a standard error is not worth more runs

// Load steps make a curve uneven, and the differences of two curves more so: effects of two parameters that differ by
// less than this cannot be told apart.
constexpr double exactness = 0.01;

}  // namespace

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

ModelCurves CurveFit::as_recorded_by_all(const SampledCurve& computed, const std::vector<double>& values,
                                         std::optional<double> until) const {
  const bool is_cut = until && !events_.empty();
  const SampledCurve& compared = is_cut ? up_to(computed, *until) : computed;
  ModelCurves curves;
  for (const SetUp& set_up : set_ups_at(values)) curves.push_back(as_recorded(compared, set_up));
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
  add_events(stage, latest, points);
  return points;
}

void CurveFit::say(const CurveFitStage& stage, const MeasuredPoints& points) {
  for (const MeasuredEvent& event : points.events)
    session_.log.say(event_words(event, job_.specimens[event.specimen].curve.name));
  session_.log.say(fmt::format("stage \"{}\": {} parameters, {} measured points from {}{}", stage.name,
                               stage.parameters.size(), points.points.size(),
                               quantities_text({std::ranges::min(points.points, {}, &MeasuredPoints::Point::x).x,
                                                std::ranges::max(points.points, {}, &MeasuredPoints::Point::x).x},
                                               "m", " to "),
                               points.events.empty() ? ""
                                                     : fmt::format(", events: {} in place of {} points",
                                                                   points.events.size(), points.left_out)));
}

std::optional<std::vector<double>> CurveFit::residuals_by_points(const ModelCurves& models,
                                                                 const MeasuredPoints& measured) {
  return residuals_of(models, measured);
}

std::optional<std::vector<double>> CurveFit::residuals_at(const std::vector<double>& values,
                                                          std::optional<double> until, const MeasuredPoints& points,
                                                          CurveModel& model, Compared compared) {
  const auto curve = model.respond(values, until);
  if (!curve) return std::nullopt;
  auto residuals = compared(as_recorded_by_all(*curve, values, until), points);
  if (!residuals || fields_.empty()) return residuals;
  const auto of_fields = field_residuals(values, until, points.events, model);
  if (!of_fields) return std::nullopt;
  residuals->insert(residuals->end(), of_fields->begin(), of_fields->end());
  return residuals;
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
  const auto residuals_by = [this, &stage, &points, &model, until](Compared compared) {
    return [=, this, &stage, &points, &model](std::span<const double> values) {
      return residuals_at(with_stage(stage, values), until, points, model, compared);
    };
  };
  problem.residuals = residuals_by(residuals_by_points);
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
  settings.cost_tolerance = least_change / static_cast<double>(points.n_data() + n_field_data());
  settings.iterated = [this, &stage](const FitIteration& iteration) {
    session_.log.say(fmt::format("  rms residual {:.5g} at {}", iteration.rms,
                                 model_.shown(with_stage(stage, iteration.parameters))));
  };
  return settings;
}

}  // namespace pfdm
