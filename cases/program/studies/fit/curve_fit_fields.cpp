// Measured displacement fields in a fit: member functions of curve_fit_at_work.h.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/quantity_text.h"
#include "postproc/curves/event_rows.h"
#include "postproc/displacements/field_path.h"
#include "postproc/displacements/field_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pfdm {
namespace {

using Eigen::MatrixXd;

constexpr double noise_at_first = 0.01;  // of the rms displacement, before residuals tell
constexpr double rounding = 1e-6;        // of the end of a run
constexpr double as_noisy = 0.05;        // relative: another standard deviation is not worth more runs

bool is_at_a_jump(const std::vector<MeasuredEvent>& events, std::size_t specimen, double displacement) {
  constexpr double sides = 3.0;  // standard deviations
  return std::ranges::any_of(events, [&](const MeasuredEvent& event) {
    return event.kind == EventKind::jump && event.specimen == specimen &&
           std::abs(displacement - event.place) < sides * event.deviation_of_place();
  });
}

double rms_of(const MatrixXd& values) { return values.norm() / std::sqrt(static_cast<double>(values.size())); }

MatrixXd measured_of(const MeasuredField& field, const FieldFrame& frame) {
  return frame_difference(field, frame, std::vector<double>(3 * (1 + std::ranges::max(frame.places)), 0.0)) * -1.0;
}

std::vector<double> at_frame(const FieldHistory& history, const StepWeights& weights) {
  std::vector<double> u(history.rows.front().size(), 0.0);
  for (const auto& [step, weight] : weights)
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += weight * history.rows[step][i];
  return u;
}

/// The steps up to the first one that reaches `until`: what a longer run has depends on which runs were made before.
SampledCurve cut(const SampledCurve& followed, std::optional<double> until) {
  if (!until) return followed;
  const auto end = std::ranges::find_if(followed.x, [&](double x) { return x >= *until; });
  const auto n = std::min(followed.x.size(), static_cast<std::size_t>(end - followed.x.begin()) + 1);
  SampledCurve part{.name = followed.name, .x = followed.x, .y = followed.y};
  part.x.resize(n);
  part.y.resize(n);
  return part;
}

}  // namespace

void CurveFit::select_frames(const CurveFitStage& stage, std::optional<double> until, const MeasuredPoints& points) {
  if (fields_.empty()) return;
  const SampledCurve curve = curve_at(first_, until);
  const std::vector<SetUp> least = least_set_ups();
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const MeasuredField& field = job_.fields.fields[k];
    const MeasuredCurve& specimen = job_.specimens[field.specimen];
    const double latest = as_recorded(curve, least[field.specimen]).x.back();
    fields_[k] = {};
    double squares = 0.0, n = 0.0;
    for (std::size_t f = 0; f < field.frames.size(); ++f) {
      const double at = field.frames[f].displacement, place = displacement_of_specimen(specimen, at);
      if (place < stage.from || place > stage.to || at > latest + rounding * std::abs(latest) ||
          is_at_a_jump(points.events, field.specimen, at))
        continue;
      fields_[k].frames.push_back(f);
      fields_[k].motions.emplace_back(field, field.frames[f]);
      squares += fields_[k].motions.back().projected(measured_of(field, field.frames[f])).squaredNorm();
      n += static_cast<double>(field.n_data(field.frames[f]));
    }
    fields_[k].deviation = field.deviation > 0.0
                               ? stated_deviation(field)
                               : std::max(noise_at_first * std::sqrt(squares / std::max(n, 1.0)), 1e-12);
    if (fields_[k].frames.empty())
      session_.log.warn(
          fmt::format("field \"{}\" does not count in stage \"{}\": none of its frames was taken between "
                      "its displacements, before the end of the run, {}, and not at a jump",
                      field.name, stage.name, quantity_text(latest, "m")));
    session_.log.say(fmt::format("field \"{}\": {} of {} frames are in the stage, standard deviation of a point {}{}",
                                 field.name, fields_[k].frames.size(), field.frames.size(),
                                 quantity_text(fields_[k].deviation, "m", 3),
                                 field.deviation > 0.0 ? "" : " at first"));
  }
}

std::size_t CurveFit::n_field_data() const {
  std::size_t n = 0;
  for (std::size_t k = 0; k < fields_.size(); ++k)
    for (const std::size_t f : fields_[k].frames) n += job_.fields.fields[k].n_data(job_.fields.fields[k].frames[f]);
  return n;
}

std::optional<CurveFit::FieldDifferences> CurveFit::field_differences(const std::vector<double>& values,
                                                                      std::optional<double> until,
                                                                      const std::vector<MeasuredEvent>& events,
                                                                      CurveModel& model) {
  const auto history = model.history(values, until);
  if (!history) return std::nullopt;
  const bool is_coarse = coarse_model_ && &model == &*coarse_model_;
  SampledCurve followed = cut(history->followed, until);
  if (is_coarse) followed = alignment_(std::move(followed));
  const std::vector<SetUp> set_ups = set_ups_at(values);
  FieldDifferences differences;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const MeasuredField& field = job_.fields.fields[k];
    const FieldPath path(followed, set_ups[field.specimen], events, field.specimen);
    differences.emplace_back();
    for (const std::size_t f : fields_[k].frames) {
      const auto weights = path.at(field.frames[f].displacement);
      if (!weights) return std::nullopt;
      differences.back().push_back(frame_difference(field, field.frames[f], at_frame(*history, *weights)));
    }
  }
  return differences;
}

std::optional<std::vector<double>> CurveFit::field_residuals(const std::vector<double>& values,
                                                             std::optional<double> until,
                                                             const std::vector<MeasuredEvent>& events,
                                                             CurveModel& model) {
  const auto differences = field_differences(values, until, events, model);
  if (!differences) return std::nullopt;
  std::vector<double> residuals;
  for (std::size_t k = 0; k < fields_.size(); ++k)
    for (std::size_t i = 0; i < fields_[k].frames.size(); ++i) {
      const Eigen::VectorXd reduced = fields_[k].motions[i].reduced((*differences)[k][i]) / fields_[k].deviation;
      residuals.insert(residuals.end(), reduced.begin(), reduced.end());
    }
  return residuals;
}

bool CurveFit::set_field_noise(const FieldDifferences& differences) {
  bool is_other = false;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    StageField& of_stage = fields_[k];
    if (of_stage.frames.empty()) continue;
    std::vector<MatrixXd> left;
    for (std::size_t i = 0; i < of_stage.frames.size(); ++i)
      left.push_back(of_stage.motions[i].projected(differences[k][i]));
    const MeasuredField& field = job_.fields.fields[k];
    of_stage.scatter = scatter_of(field, of_stage.frames, left);
    const double stated = stated_deviation(field), found = of_stage.scatter.deviation * of_stage.scatter.inflation;
    const double due = std::max({field.deviation > 0.0 && found < 1.1 * stated ? 0.0 : found, stated, 1e-15});
    is_other = is_other || std::abs(due / of_stage.deviation - 1.0) > as_noisy;
    if (std::abs(due / of_stage.deviation - 1.0) > as_noisy) of_stage.deviation = due;
  }
  return is_other;
}

void CurveFit::weigh_fields(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                            MeasuredPoints& points, FittedPoints& fitted) {
  constexpr int most_turns = 3;
  if (n_field_data() == 0) return;
  for (int turn = 0; turn < most_turns; ++turn) {
    const std::vector<double> estimates = fitted.result.values();
    const auto differences = field_differences(with_stage(stage, estimates), until, points.events, model_);
    if (!differences || !set_field_noise(*differences)) return;
    session_.log.say("  again, for the noise of the fields is another one than it was taken for");
    FitProblem problem = problem_of(stage, points, until, model_);
    for (std::size_t j = 0; j < estimates.size(); ++j) problem.parameters[j].start = estimates[j];
    fitted = fit_points(stage, points, until, from_one_start(settings), problem);
  }
}

bool CurveFit::finer_explains(const DoneStage& done, const FitFindings& found, std::size_t field) {
  if (!finer_ || &done.stage != &job_.settings.stages.back()) return false;
  std::vector<double> values = values_;  // as the finer case would have them
  for (std::size_t j = 0; j < done.stage.parameters.size(); ++j)
    if (const double move = found.parameters[j].moved_by_finer; std::isfinite(move))
      values[done.stage.parameters[j]] += move;
  CurveModel model(finer_->file, parameters_, job_.read_curve, job_.read_history, runs_);
  const auto differences = field_differences(values, done.until, done.points.events, model);
  if (!differences) return false;
  std::vector<MatrixXd> left;
  for (std::size_t i = 0; i < fields_[field].frames.size(); ++i)
    left.push_back(fields_[field].motions[i].projected((*differences)[field][i]));
  return !scatter_of(job_.fields.fields[field], fields_[field].frames, left).is_long_ranged;
}

void CurveFit::doubt_fields(const DoneStage& done, FitFindings& found) {
  if (n_field_data() == 0) return;
  const auto differences = field_differences(values_, done.until, done.points.events, model_);
  if (!differences) return;
  auto row = static_cast<std::ptrdiff_t>(done.points.n_data());
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    if (fields_[k].frames.empty()) continue;
    const std::ptrdiff_t first = row;
    for (const std::size_t f : fields_[k].frames)
      row += static_cast<std::ptrdiff_t>(job_.fields.fields[k].n_data(job_.fields.fields[k].frames[f]));
    doubt_noise(k, found);
    if (!doubt_scale(done, k, (*differences)[k], {first, row}, found)) doubt_correlation(done, k, found);
  }
}

void CurveFit::doubt_noise(std::size_t k, FitFindings& found) const {
  constexpr double noticeable = 1.1, surely = 3.3;
  const MeasuredField& field = job_.fields.fields[k];
  const FieldScatter& scatter = fields_[k].scatter;
  const double stated = stated_deviation(field), ratio = stated > 0.0 ? scatter.deviation / stated : 0.0;
  if (ratio > noticeable && ratio * ratio > 1.0 + surely * std::sqrt(2.0 / scatter.freedom))
    question(found, fmt::format("the displacements of field \"{}\" scatter {:.3g} times as much about the fit as its "
                                "deviation says; where subsets overlap, say their side by \"subset\"",
                                field.name, ratio));
}

bool CurveFit::doubt_scale(const DoneStage& done, std::size_t k, const std::vector<MatrixXd>& differences,
                           std::pair<std::ptrdiff_t, std::ptrdiff_t> rows, FitFindings& found) const {
  constexpr double telling = 0.8, least = 0.002;
  const MeasuredField& field = job_.fields.fields[k];
  const StageField& of_stage = fields_[k];
  std::vector<double> computed, residuals;
  for (std::size_t i = 0; i < of_stage.frames.size(); ++i) {
    const MatrixXd of_run = differences[i] + measured_of(field, field.frames[of_stage.frames[i]]);
    for (const auto& [from, to] : {std::pair(&differences[i], &residuals), std::pair(&of_run, &computed)}) {
      const Eigen::VectorXd reduced = of_stage.motions[i].reduced(*from) / of_stage.deviation;
      to->insert(to->end(), reduced.begin(), reduced.end());
    }
  }
  std::vector<std::vector<double>> columns{computed};
  for (Eigen::Index j = 0; j < done.result.derivatives.cols(); ++j) {
    const auto column = done.result.derivatives.col(j).segment(rows.first, rows.second - rows.first);
    if (column.norm() > 0.0) columns.emplace_back(column.begin(), column.end());
  }
  const double scale = explained_by(residuals, columns)[0], left = rms_left_by(residuals, columns),
               rms = rms_left_by(residuals, {});
  if (!(std::abs(scale) > least && left < telling * rms)) return false;
  question(found,
           fmt::format("displacements of field \"{}\" that were {:.3g} times as large would leave less (rms {:.3g} "
                       "for {:.3g} of the noise it counts with): see its \"unit\", \"pixel\" and \"factor\"",
                       field.name, 1.0 / (1.0 - scale), left, rms));
  return true;
}

void CurveFit::doubt_correlation(const DoneStage& done, std::size_t k, FitFindings& found) {
  constexpr double noticeable = 1.25;
  const std::string& name = job_.fields.fields[k].name;
  const FieldScatter& scatter = fields_[k].scatter;
  if (!(scatter.inflation > noticeable)) return;
  const std::string over =
      fmt::format("the residuals of field \"{}\" are correlated over {}{}", name, quantity_text(scatter.over, "m", 2),
                  scatter.over_frames ? " and over frames" : "");
  if (!scatter.is_long_ranged)
    found.warnings.push_back(fmt::format("{}: it counts with a standard deviation {:.2g} times that of their scatter",
                                         over, scatter.inflation));
  else if (finer_explains(done, found, k))
    found.warnings.push_back(
        fmt::format("{}: they hold the error of the discretisation, which {} takes out", over, finer_->shown));
  else
    question(found, fmt::format("{} or more, which is no noise: an error of the model, of \"plane\" or of the "
                                "displacements at which frames were taken",
                                over));
}

std::vector<FittedField> CurveFit::fitted_fields() {
  std::vector<FittedField> told;
  if (fields_.empty()) return told;
  const auto differences = field_differences(values_, end_of_runs(job_.settings.stages.back()), events_, model_);
  if (!differences) return told;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const MeasuredField& field = job_.fields.fields[k];
    const StageField& of_stage = fields_[k];
    FittedField& f = told.emplace_back(FittedField{.name = field.name,
                                                   .specimen = job_.specimens[field.specimen].curve.name,
                                                   .file = fmt::format("{}{}.csv", field_tables, k),
                                                   .pitch = field.pitch,
                                                   .n_data = 0,
                                                   .deviation = of_stage.deviation,
                                                   .stated = field.deviation,
                                                   .inflation = of_stage.scatter.inflation,
                                                   .over = of_stage.scatter.over,
                                                   .over_frames = of_stage.scatter.over_frames});
    std::vector<MetFrame> met;
    for (std::size_t i = 0; i < of_stage.frames.size(); ++i) {
      const FieldFrame& frame = field.frames[of_stage.frames[i]];
      const RigidMotion& motion = of_stage.motions[i];
      met.push_back(
          {.frame = &frame, .measured = measured_of(field, frame), .left = motion.projected((*differences)[k][i])});
      met.back().rms_without_motion = rms_of(motion.projected(met.back().measured));
      f.n_data += field.n_data(frame);
      f.frames.push_back(figures_of(met.back()));
    }
    tables_[f.file] = field_table(field, met, job_.name);
  }
  return told;
}

}  // namespace pfdm
