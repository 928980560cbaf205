// What speaks against a fit of a curve, and the intervals of one that is sound.

#include "cases/program/session/runnable_case.h"
#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "cases/program/studies/fit/interval_trial.h"
#include "cases/program/studies/runs/finer_case.h"
#include "physics/quantity_text.h"
#include "postproc/curves/record_faults.h"
#include "postproc/fits/record_doubts.h"
#include "solver/calibration/profile_likelihood.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_noise = 1e-3;  // of the rms force: what load steps leave scatters as it likes

std::vector<FittedRecord> records_of(const MeasuredPoints& points, const std::vector<MeasuredCurve>& specimens,
                                     const FitResult& result) {
  std::vector<FittedRecord> records;
  std::size_t specimen = 0;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const MeasuredPoints::Point& at = points.points[i];
    if (records.empty() || at.specimen != specimen)
      records.push_back({.row = [&points, first = i, name = specimens[at.specimen].curve.name](std::size_t row) {
        const MeasuredPoints::Point& there = points.points[first + row];
        return fmt::format("the row of {} with {} at {}", name, quantity_text(there.y, "N", 4),
                           quantity_text(there.x, "m", 4));
      }});
    specimen = at.specimen;
    const double measured = at.y / points.scale(at);
    records.back().measured.push_back(measured);
    records.back().size.push_back(std::abs(measured + result.residuals[i]));
  }
  return records;
}

/// Standard deviation of the forces of a specimen [N]: the largest that is stated, else their scatter about the model.
double scatter_of(const MeasuredPoints& points, const ModelCurves& models, std::size_t specimen) {
  double stated = 0.0;
  for (const MeasuredPoints::Point& point : points.points)
    if (point.specimen == specimen) stated = std::max(stated, point.deviation);
  return stated > 0.0 ? stated : rms_difference(models.at(specimen), points, specimen);
}

}  // namespace

void CurveFit::doubt(const DoneStage& done, bool model_error, FitFindings& found) {
  for (std::size_t k = 0; k < done.stage.parameters.size(); ++k) try_compliance(done, k, found);
  const SampledCurve fitted = curve_at(values_, done.until);
  const std::vector<std::string> origins = missed_origins(done, fitted);
  const bool is_tried = model_error && found.verdict != Verdict::failed;
  if (!(is_tried && suspect_law_or_set_up(done, fitted, !origins.empty(), found)))
    for (const std::string& origin : origins) question(found, origin);
  if (!is_sound(found.verdict))
    for (std::string& unit : doubts_of_unit(as_recorded_by_all(curve_at(first_, done.until), first_, done.until),
                                            done.points, job_.specimens))
      question(found, std::move(unit));
  if (is_tried)
    if (auto apart = doubt_of_specimens(done.result.residuals, done.points, job_.specimens))
      question(found, std::move(*apart));
  doubt_events(done, fitted, found);
  doubt_fields(done, found);
  suspect_preload(found);
  const std::vector<FittedRecord> records = records_of(done.points, job_.specimens, done.result);
  doubt_stray_row(done.result, records, least_noise, found);
  widen_for_uneven_scatter(done.result, records, least_noise,
                           "the deviation of each row, stated, makes the estimates exacter", found);
}

void CurveFit::try_compliance(const DoneStage& done, std::size_t k, FitFindings& found) const {
  const CaseParameter& parameter = parameters_[done.stage.parameters[k]];
  if (!is_of_set_up_[done.stage.parameters[k]] || parameter.dimension.name != dimension::compliance.name) return;
  std::vector<CaseParameter> of_stage;
  for (const std::size_t j : done.stage.parameters) of_stage.push_back(parameters_[j]);
  auto reason = doubt_of_interval({done.problem, done.settings, done.result, of_stage}, k, session_.log);
  if (reason) question(found, std::move(*reason));
}

std::vector<double> CurveFit::residuals_of_curve(const DoneStage& done) {
  const std::vector<double>& all = done.result.residuals;
  return {all.begin(), all.begin() + done.points.n_data()};
}

bool CurveFit::suspect_law_or_set_up(const DoneStage& done, const SampledCurve& fitted, bool misses_origin,
                                     FitFindings& found) {
  constexpr double telling_set_up = 0.5, telling_law = 0.8, alike = 1.2;  // of the rms
  const double rms = done.result.rms;
  const std::vector<std::vector<double>> errors =
      set_up_errors(as_recorded_by_all(fitted, values_, done.until), done.points);
  const std::vector<double> of_curve = residuals_of_curve(done);
  const double left = rms_left_by(of_curve, errors);
  const bool is_set_up = left < telling_set_up * rms_left_by(of_curve, {}) && !preloads(done, errors);
  const auto law = misses_origin && !is_set_up ? std::nullopt : other_law(done);
  if (law && law->rms < telling_law * rms && (!is_set_up || law->rms < alike * left)) {
    question(found,
             fmt::format("another law would explain more: with {}, all parameters estimated anew, the rms of the "
                         "residuals falls from {:.3g} to {:.3g}",
                         law->shown, rms, law->rms));
    return true;
  }
  if (!is_set_up) return false;
  question(found, fmt::format("an offset of force or displacement, or the compliance of the set-up, would explain most "
                              "of the residuals: with them their rms falls from {:.3g} to {:.3g}; correct the measured "
                              "curve for them, or estimate them (offset, force_offset and compliance of [experiment])",
                              rms, left));
  return true;
}

std::optional<TriedLaw> CurveFit::other_law(const DoneStage& done) {
  std::vector<CaseVariant> laws;
  for (const CaseVariant& law : job_.other_laws) try {
      session_.read_case(with_values(law.file, parameters_, values_));
      laws.push_back(law);
    } catch (const InputError&) {  // a law that lacks keys, or that the case's own rules exclude
    }
  std::vector<CurveModel> models;
  models.reserve(laws.size() + 1);
  const auto problem_with = [&](const CaseFile& file) {
    models.emplace_back(file, parameters_, job_.read_curve, job_.read_history, runs_);
    return problem_of(done.stage, done.points, done.until, models.back());
  };
  return best_other_law(laws, done.result, problem_with, done.settings, session_.log);
}

bool CurveFit::preloads(const DoneStage& done, const std::vector<std::vector<double>>& errors) const {
  const double offset = explaining_force_offset(residuals_of_curve(done), errors);
  return std::ranges::any_of(job_.specimens,
                             [&](const MeasuredCurve& s) { return contradicts_unloaded_start(s.curve, offset); });
}

void CurveFit::suspect_preload(FitFindings& found) const {
  const std::vector<SetUp> set_ups = set_ups_at(values_);
  for (std::size_t s = 0; s < job_.specimens.size(); ++s) {
    const SampledCurve& curve = job_.specimens[s].curve;
    const double offset = set_ups[s].force_offset;
    if (set_ups[s] == job_.specimens[s].set_up || !contradicts_unloaded_start(curve, offset)) continue;
    question(found, fmt::format("a force_offset of {} contradicts the first row of {}, {}: the specimen would "
                                "have been loaded before; another law, or a force_offset that is given",
                                quantity_text(offset, "N"), curve.name, quantity_text(curve.y.front(), "N", 3)));
  }
}

std::vector<std::string> CurveFit::missed_origins(const DoneStage& done, const SampledCurve& fitted) const {
  std::vector<std::string> reasons;
  const std::vector<SetUp> set_ups = set_ups_at(values_);
  std::vector<MeasuredCurve> specimens = job_.specimens;
  const ModelCurves models = as_recorded_by_all(fitted, values_, done.until);
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    specimens[s].set_up = set_ups[s];
    auto doubt = doubt_of_origin(specimens[s].of_specimen(), fitted, job_.straight_from, job_.straight_to);
    if (!doubt) doubt = doubt_of_rise(specimens, s, fitted, scatter_of(done.points, models, s));
    if (doubt) reasons.push_back(std::move(*doubt));
  }
  return reasons;
}

std::optional<FinerModel> CurveFit::on_finer_model(const DoneStage& done) {
  if (!finer_ || &done.stage != &job_.settings.stages.back()) return std::nullopt;
  session_.log.say(fmt::format("  at the estimates with {}", finer_->shown));
  CurveModel model(finer_->file, parameters_, job_.read_curve, job_.read_history, runs_);
  auto residuals = residuals_at(values_, done.until, done.points, model, residuals_by_points);
  if (residuals) return FinerModel{finer_->shown, std::move(*residuals)};
  session_.log.warn(fmt::format("with {} the run does not converge, or not as far as the data go", finer_->shown));
  return std::nullopt;
}

void CurveFit::add_profiles(const DoneStage& done, FitFindings& found) const {
  for (std::size_t k = 0; k < done.stage.parameters.size(); ++k) {
    const CaseParameter& parameter = parameters_[done.stage.parameters[k]];
    if (&done.stage != &*last_stage_of(done.stage.parameters[k])) continue;
    const ProfileSettings how{
        .due = reach_of_widened(found.parameters[k]), .trying = [&](std::size_t, double value) {
          session_.log.say(fmt::format("  profile: {} = {}", parameter.short_name(), parameter.shown(value)));
        }};
    const ProfileInterval interval = profile_interval(done.problem, done.settings, done.result, k, how);
    if (interval.better)
      return question(found,
                      fmt::format("the fit has ended beside the lowest residuals: they are smaller with {} = {}; "
                                  "more starts may find them",
                                  parameter.name, parameter.shown(interval.better->value)));
    FittedProfile profile{.lower = interval.lower_95,
                          .upper = interval.upper_95,
                          .lower_open = interval.lower_open,
                          .upper_open = interval.upper_open};
    hold_move(found.parameters[k], profile.lower, profile.upper);
    found.parameters[k].profile = profile;
  }
}

std::vector<ResidualSeries> CurveFit::series_of(const MeasuredPoints& points,
                                                const std::vector<double>& residuals) const {
  std::vector<ResidualSeries> result;
  for (const MeasuredCurve& specimen : job_.specimens)
    result.push_back({.name = specimen.curve.name, .along = "displacement", .values = {}});
  const std::size_t n = points.points.size(), n_data = points.n_data();
  for (std::size_t i = 0; i < n; ++i) result[points.points[i].specimen].values.push_back(residuals[i]);
  if (n_data > n)  // those of fields come behind, and are judged by themselves
    result.push_back(
        {.name = "the events", .along = "displacement", .values = {residuals.begin() + n, residuals.begin() + n_data}});
  return result;
}

}  // namespace pfdm
