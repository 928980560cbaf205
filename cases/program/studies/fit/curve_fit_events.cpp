// Events of the curves in a fit: which a stage meets, what speaks against them, and what is said of them.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/quantity_text.h"
#include "postproc/curves/event_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pfdm {
namespace {

constexpr double surely_elsewhere = 4.0;  // standard deviations

bool is_in(const CurveFitStage& stage, const MeasuredEvent& event, const std::vector<MeasuredCurve>& specimens) {
  const double place = displacement_of_specimen(specimens[event.specimen], event.place);
  return place >= stage.from && place <= stage.to;
}

std::string lacking_text(const MeasuredEvent& event, const std::string& specimen) {
  if (event.kind == EventKind::first_debonding)
    return fmt::format(
        "nothing debonds in the fitted run, or it has no surface that could ([cohesive], [[interface]]): "
        "the residuals of the {} of {} are those of the end of the curve",
        event.name(), specimen);
  if (event.kind == EventKind::greatest_force)
    return fmt::format(
        "the force of the fitted curve is greatest at its end: it has not reached the {} of {}, whose residuals are "
        "those of the end of the curve",
        event.name(), specimen);
  return fmt::format(
      "the fitted curve lacks {} of {}: nowhere else does its force fall in one step by more than {:g} % "
      "of the largest; its residuals are those of the largest fall, or of the end of the curve",
      event.name(), specimen, 100.0 * event.least_fall);
}

}  // namespace

bool is_as_exact(const MeasuredEvent& a, const MeasuredEvent& b) {
  constexpr double noticeable = 0.05;
  return std::abs(a.deviation_of_place() - b.deviation_of_place()) <= noticeable * b.deviation_of_place();
}

std::optional<std::string> warning_of_steps(const MeasuredEvent& used, const MeasuredEvent& at_estimates,
                                            const std::string& specimen) {
  if (is_as_exact(used, at_estimates)) return std::nullopt;
  return fmt::format(
      "{} of {} counts with a standard deviation of {}, by a load step about it that is not that of the estimates: "
      "with theirs it would be {}. Intervals rest on it; take steps of one length about it (loading.maximum_increment, "
      "or loading.finest_increment where steps are cut)",
      used.name(), specimen, quantity_text(used.deviation_of_place(), "m", 2),
      quantity_text(at_estimates.deviation_of_place(), "m", 2));
}

std::vector<MeasuredEvent> CurveFit::widened_events(const CurveFitStage& stage, const std::vector<double>& values,
                                                    std::optional<double> until) {
  if (events_.empty()) return {};
  std::vector<MeasuredEvent> events = events_;
  const ModelCurves curves = as_recorded_by_all(curve_at(values, until), values, until);
  for (std::size_t k = 0; k < events.size(); ++k) {
    if (!is_in(stage, events[k], job_.specimens)) continue;
    events[k] = job_.events[k];
    const SampledCurve& curve = curves[events[k].specimen];
    const ComputedEvent computed = computed_event(events[k], curve);
    const double step = computed.is_there ? computed.step : step_at(curve, events[k].place);
    for (MeasuredFigure& figure : events[k].figures)
      if (figure.counts && figure.figure == EventFigure::displacement)
        figure.deviation = std::hypot(figure.deviation, step / std::sqrt(12.0));
  }
  return events;
}

void CurveFit::add_events(const CurveFitStage& stage, const std::vector<double>& latest, MeasuredPoints& points) {
  for (const MeasuredEvent& event : events_) {
    if (!is_in(stage, event, job_.specimens)) continue;
    if (event.place > latest[event.specimen])
      throw job_.settings.where.error(fmt::format(
          "{} of \"{}\" lies beyond the end of the computed curve, {}: load further, or leave it out of "
          "[[experiment.events]]",
          event.name(), job_.specimens[event.specimen].curve.name, quantity_text(latest[event.specimen], "m")));
    points.events.push_back(event);
  }
  if (!points.events.empty()) job_.settings.where.in_context([&] { leave_out_rows_of_events(points); });
}

bool CurveFit::finer_meets(const DoneStage& done, const MeasuredEvent& event, const MeasuredFigure& figure) {
  if (!finer_ || &done.stage != &job_.settings.stages.back()) return false;
  CurveModel model(finer_->file, parameters_, job_.read_curve, job_.read_history, runs_);
  const auto curve = model.respond(values_, done.until);
  if (!curve) return false;
  const ComputedEvent computed = computed_event(event, as_recorded_by_all(*curve, values_, done.until)[event.specimen]);
  return computed.is_there && std::abs(residual_of(computed, figure)) <= surely_elsewhere;
}

void CurveFit::doubt_derivatives(const DoneStage& done, const MeasuredEvent& event, const ComputedEvent& computed,
                                 Eigen::Index row, FitFindings& found) const {
  constexpr double least_steps = 2.0;
  const double sides = done.settings.differences == Differences::forward ? 1.0 : 2.0;
  std::optional<double> most;  // by parameters that runs depend on
  for (std::size_t k = 0; k < done.problem.parameters.size(); ++k) {
    const FitParameter& p = done.problem.parameters[k];
    if (is_of_set_up_[done.stage.parameters[k]]) continue;
    const double difference = sides * done.settings.step * (p.log_scale ? 1.0 : std::abs(p.first));
    const double derivative = event.deviation_of_place() * done.result.derivatives(row, static_cast<Eigen::Index>(k));
    most = std::max(most.value_or(0.0), std::abs(derivative * difference));
  }
  if (most && computed.is_there && *most < least_steps * computed.step)
    question(found,
             fmt::format("{} moves by {} over the differences of the parameters, and lies within a load step of {}: "
                         "its derivatives are those of the steps; take shorter load steps about it, or a longer "
                         "step in [fit]",
                         event.name(), quantity_text(*most, "m", 2), quantity_text(computed.step, "m", 2)));
}

void CurveFit::warn_of_steps(const DoneStage& done, FitFindings& found) {
  const std::vector<MeasuredEvent> at_estimates = widened_events(done.stage, values_, done.until);
  for (std::size_t k = 0; k < at_estimates.size(); ++k) {
    if (!is_in(done.stage, events_[k], job_.specimens)) continue;
    const std::string& specimen = job_.specimens[events_[k].specimen].curve.name;
    if (auto warning = warning_of_steps(events_[k], at_estimates[k], specimen))
      found.warnings.push_back(std::move(*warning));
  }
}

void CurveFit::doubt_events(const DoneStage& done, const SampledCurve& fitted, FitFindings& found) {
  if (done.points.events.empty()) return;
  ModelCurves curves = as_recorded_by_all(fitted, values_, done.until);
  auto row = std::ssize(done.points.points);
  for (const MeasuredEvent& event : done.points.events) {
    SampledCurve& curve = curves[event.specimen];
    curve.name = job_.specimens[event.specimen].curve.name;
    const ComputedEvent computed = computed_event(event, curve);
    if (!computed.is_there) question(found, lacking_text(event, curve.name));
    for (const MeasuredFigure& figure : event.figures) {
      if (!figure.counts) continue;
      if (figure.figure == EventFigure::displacement) doubt_derivatives(done, event, computed, row, found);
      ++row;
      if (!computed.is_there) continue;
      const double residual = residual_of(computed, figure);
      if (std::abs(residual) > surely_elsewhere && !finer_meets(done, event, figure))
        question(found,
                 fmt::format("{} of {} has a computed {} of {}, {:.1f} standard deviations from the measured {}",
                             event.name(), curve.name, in_words(figure.figure),
                             quantity_text(computed.of(figure.figure), std::string(unit_of(figure.figure))),
                             std::abs(residual), quantity_text(figure.value, std::string(unit_of(figure.figure)))));
    }
  }
  for (std::size_t s = 0; s < curves.size(); ++s)
    if (!has_jumps_in_order(curves[s], done.points.events, s))
      question(found, fmt::format("two events of {} are the same jump of the fitted curve, or in another order: give "
                                  "them a number",
                                  job_.specimens[s].curve.name));
}

const CurveFitStage& CurveFit::last_stage_of(const MeasuredEvent& event) const {
  const std::vector<CurveFitStage>& stages = job_.settings.stages;
  return *std::ranges::find_if(stages.rbegin(), stages.rend(),
                               [&](const CurveFitStage& stage) { return is_in(stage, event, job_.specimens); });
}

std::vector<FittedEvent> CurveFit::fitted_events(const SampledCurve& fitted) const {
  constexpr EventFigure of_jump[] = {EventFigure::displacement, EventFigure::force_before, EventFigure::force_after};
  constexpr EventFigure of_greatest[] = {EventFigure::displacement, EventFigure::force};
  std::vector<FittedEvent> events;
  const std::vector<SetUp> set_ups = set_ups_at(values_);
  for (const MeasuredEvent& event : events_) {
    const ModelCurves curves = as_recorded_by_all(fitted, values_, end_of_runs(last_stage_of(event)));
    const ComputedEvent computed = computed_event(event, curves[event.specimen]);
    FittedEvent told{.name = event.name(),
                     .specimen = job_.specimens[event.specimen].curve.name,
                     .is_found = event.is_found,
                     .is_there = computed.is_there,
                     .set_up = set_ups[event.specimen]};
    const auto add = [&](EventFigure figure) {
      FittedEvent::Figure& f = told.figures.emplace_back(FittedEvent::Figure{
          .name = std::string(name_of(figure)), .unit = std::string(unit_of(figure)), .computed = computed.of(figure)});
      const auto measured = std::ranges::find(event.figures, figure, &MeasuredFigure::figure);
      if (measured == event.figures.end()) return;
      f.measured = measured->value;
      f.deviation = measured->deviation;
      if (measured->counts) f.residual = residual_of(computed, *measured);
    };
    if (event.kind == EventKind::greatest_force)
      std::ranges::for_each(of_greatest, add);
    else
      std::ranges::for_each(of_jump, add);
    events.push_back(std::move(told));
  }
  return events;
}

void require_in_a_stage(const CurveFitSettings& settings, const std::vector<MeasuredCurve>& specimens,
                        const std::vector<MeasuredEvent>& events) {
  for (const MeasuredEvent& event : events)
    if (std::ranges::none_of(settings.stages,
                             [&](const CurveFitStage& stage) { return is_in(stage, event, specimens); }))
      throw settings.where.at("stages").error(fmt::format(
          "{} of \"{}\", at {} of the specimen, lies between the displacements of no stage: it would not count; widen "
          "\"between\" of a stage, or leave it out of [[experiment.events]]",
          event.name(), specimens[event.specimen].curve.name,
          quantity_text(displacement_of_specimen(specimens[event.specimen], event.place), "m")));
}

}  // namespace pfdm
