// Events of the curves in a fit: which a stage meets, what speaks against them, and what is said of them.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pfdm {
namespace {

constexpr double surely_elsewhere = 4.0;  // standard deviations

std::string lacking_text(const MeasuredEvent& event, const std::string& specimen) {
  if (event.kind == EventKind::first_debonding)
    return fmt::format(
        "nothing debonds in the fitted run, or it has no surface that could ([cohesive], [[interface]]): "
        "the residuals of the {} of {} are those of the end of the curve",
        event.name(), specimen);
  return fmt::format(
      "the fitted curve lacks {} of {}: nowhere else does its force fall in one step by more than {:g} % "
      "of the largest; its residuals are those of the largest fall, or of the end of the curve",
      event.name(), specimen, 100.0 * event.least_fall);
}

/// Where the load steps about the event are much longer than they were with the first guess.
std::optional<std::string> coarseness(const MeasuredEvent& event, const SampledCurve& curve) {
  constexpr double longer = 1.5;
  const double step = computed_event(event, curve).step;
  if (!(step / std::sqrt(12.0) > longer * event.deviation_of_place()) || event.deviation_of_place() == 0.0)
    return std::nullopt;
  return fmt::format(
      "{} of {} is computed within a load step of {}, beside which its standard deviation of {} is small: "
      "the intervals do not hold that; take shorter load steps about it",
      event.name(), curve.name, quantity_text(step, "m", 2), quantity_text(event.deviation_of_place(), "m", 2));
}

}  // namespace

void CurveFit::widen_events() {
  events_ = job_.events;
  if (events_.empty()) return;
  const ModelCurves curves = as_recorded_by_all(curve_at(first_, std::nullopt), first_);
  for (MeasuredEvent& event : events_) {
    const SampledCurve& curve = curves[event.specimen];
    const double step = computed_event(event, curve).step;
    for (MeasuredFigure& figure : event.figures)
      if (figure.counts && figure.figure == EventFigure::displacement)
        figure.deviation = std::hypot(figure.deviation, step / std::sqrt(12.0));
    session_.log.say(event_words(event, job_.specimens[event.specimen].curve.name));
  }
}

void CurveFit::add_events(const CurveFitStage& stage, const std::vector<double>& latest, MeasuredPoints& points) {
  for (const MeasuredEvent& event : events_) {
    const MeasuredCurve& specimen = job_.specimens[event.specimen];
    const double place = event.place - specimen.set_up.offset;
    if (place < stage.from || place > stage.to) continue;
    if (event.place > latest[event.specimen])
      throw job_.settings.where.error(
          fmt::format("{} of \"{}\" lies beyond the end of the computed curve, {}: load further, or leave it out of "
                      "[[experiment.events]]",
                      event.name(), specimen.curve.name, quantity_text(latest[event.specimen], "m")));
    points.events.push_back(event);
  }
  if (!points.events.empty()) job_.settings.where.in_context([&] { leave_out_near_events(points); });
}

bool CurveFit::finer_meets(const DoneStage& done, const MeasuredEvent& event, const MeasuredFigure& figure) {
  if (!finer_ || &done.stage != &job_.settings.stages.back()) return false;
  CurveModel model(finer_->file, parameters_, job_.read_curve, runs_);
  const auto curve = model.respond(values_, done.until);
  if (!curve) return false;
  const ComputedEvent computed = computed_event(event, as_recorded_by_all(*curve, values_)[event.specimen]);
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

void CurveFit::doubt_events(const DoneStage& done, const SampledCurve& fitted, FitFindings& found) {
  if (done.points.events.empty()) return;
  ModelCurves curves = as_recorded_by_all(done.until ? up_to(fitted, *done.until) : fitted, values_);
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
    if (auto warning = coarseness(event, curve)) found.warnings.push_back(std::move(*warning));
  }
  for (std::size_t s = 0; s < curves.size(); ++s)
    if (!has_jumps_as_measured(curves[s], done.points.events, s) &&
        std::ranges::all_of(done.points.events, [&](const MeasuredEvent& event) {
          return event.specimen != s || computed_event(event, curves[s]).is_there;
        }))
      question(found, fmt::format("two events of {} are the same jump of the fitted curve, or in another order: give "
                                  "them a number",
                                  job_.specimens[s].curve.name));
}

std::vector<FittedEvent> CurveFit::fitted_events(const SampledCurve& fitted) const {
  constexpr EventFigure of_jump[] = {EventFigure::displacement, EventFigure::force_before, EventFigure::force_after};
  constexpr EventFigure of_greatest[] = {EventFigure::displacement, EventFigure::force};
  std::vector<FittedEvent> events;
  const ModelCurves curves = as_recorded_by_all(fitted, values_);
  for (const MeasuredEvent& event : events_) {
    const ComputedEvent computed = computed_event(event, curves[event.specimen]);
    FittedEvent told{.name = event.name(),
                     .specimen = job_.specimens[event.specimen].curve.name,
                     .is_found = event.is_found,
                     .is_there = computed.is_there};
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

}  // namespace pfdm
