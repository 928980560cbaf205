// Measured displacement fields in a fit: member functions of curve_fit_at_work.h.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/error.h"
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

std::vector<double> at_frame(const FieldHistory& history, const StepWeights& weights) {
  std::vector<double> u(history.rows.front().size(), 0.0);
  for (const auto& [step, weight] : weights)
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += weight * history.rows[step][i];
  return u;
}

/// Of these data as many as the parameters take: the trace of their part of J (J^T J)^-1 J^T.
double taken_by_parameters(const FitResult& result, Eigen::Index first, Eigen::Index n) {
  if (result.derivatives.rows() < first + n) return 0.0;
  const MatrixXd of_field = result.derivatives.middleRows(first, n);
  return (of_field * result.inverse_normal).cwiseProduct(of_field).sum();
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
    const SampledCurve recorded = as_recorded(curve, least[field.specimen]);
    const double latest = recorded.x.back(), slack = rounding * std::abs(latest);
    fields_[k] = {};
    std::size_t n_before = 0;
    for (std::size_t f = 0; f < field.frames.size(); ++f) {
      const double at = field.frames[f].displacement, place = displacement_of_specimen(specimen, at);
      if (place < stage.from || place > stage.to || at > latest + slack ||
          is_at_a_jump(points.events, field.specimen, at))
        continue;
      if (at < recorded.x.front() - slack) {
        ++n_before;
        continue;
      }
      fields_[k].frames.push_back(f);
      fields_[k].motions.emplace_back(field, field.frames[f]);
    }
    if (n_before > 0)
      session_.log.warn(fmt::format("field \"{}\": {} frames left out: they were taken before the run begins, at {}",
                                    field.name, n_before, quantity_text(recorded.x.front(), "m")));
    set_first_noise(stage, k, latest);
  }
}

void CurveFit::set_first_noise(const CurveFitStage& stage, std::size_t k, double latest) {
  const MeasuredField& field = job_.fields.fields[k];
  StageField& of_stage = fields_[k];
  const std::size_t n = n_field_data(k);
  if (of_stage.frames.empty())
    session_.log.warn(
        fmt::format("field \"{}\" does not count in stage \"{}\": none of its frames was taken between "
                    "its displacements, before the end of the run, {}, and not at a jump",
                    field.name, stage.name, quantity_text(latest, "m")));
  else if (!(field.deviation > 0.0) && n < fewest_for_noise)
    throw InputError(fmt::format("stage \"{}\": {}", stage.name, too_few_for_noise(field.name, n)));
  double squares = 0.0;
  for (std::size_t i = 0; i < of_stage.frames.size(); ++i)
    squares += of_stage.motions[i].projected(measured_of(field, field.frames[of_stage.frames[i]])).squaredNorm();
  of_stage.deviation =
      field.deviation > 0.0
          ? stated_deviation(field)
          : std::max(noise_at_first * std::sqrt(squares / std::max(static_cast<double>(n), 1.0)), 1e-12);
  session_.log.say(fmt::format("field \"{}\": {} of {} frames are in the stage, standard deviation of a point {}{}",
                               field.name, of_stage.frames.size(), field.frames.size(),
                               quantity_text(of_stage.deviation, "m", 3), field.deviation > 0.0 ? "" : " at first"));
}

std::size_t CurveFit::n_field_data(std::size_t k) const {
  std::size_t n = 0;
  for (const std::size_t f : fields_[k].frames) n += job_.fields.fields[k].n_data(job_.fields.fields[k].frames[f]);
  return n;
}

std::size_t CurveFit::n_field_data() const {
  std::size_t n = 0;
  for (std::size_t k = 0; k < fields_.size(); ++k) n += n_field_data(k);
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

std::vector<MatrixXd> CurveFit::without_motion(std::size_t k, const FieldDifferences& differences) const {
  std::vector<MatrixXd> left;
  for (std::size_t i = 0; i < fields_[k].frames.size(); ++i)
    left.push_back(fields_[k].motions[i].projected(differences[k][i]));
  return left;
}

bool CurveFit::find_scatter(const CurveFitStage& stage, std::optional<double> until, const MeasuredPoints& points,
                            const FitResult& result) {
  const auto differences = field_differences(with_stage(stage, result.values()), until, points.events, model_);
  if (!differences) return false;
  auto row = static_cast<Eigen::Index>(points.n_data());
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    StageField& of_stage = fields_[k];
    if (of_stage.frames.empty()) continue;
    const auto n = static_cast<Eigen::Index>(n_field_data(k));
    of_stage.scatter = scatter_of(job_.fields.fields[k], of_stage.frames, without_motion(k, *differences),
                                  taken_by_parameters(result, row, n));
    row += n;
  }
  return true;
}

bool CurveFit::take_noise() {
  bool is_other = false;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    StageField& of_stage = fields_[k];
    if (of_stage.frames.empty()) continue;
    const MeasuredField& field = job_.fields.fields[k];
    const double stated = stated_deviation(field), found = of_stage.scatter.deviation * of_stage.scatter.inflation;
    const double due = std::max({field.deviation > 0.0 && found < 1.1 * stated ? 0.0 : found, stated, 1e-15});
    if (!(std::abs(due / of_stage.deviation - 1.0) > as_noisy)) continue;
    of_stage.deviation = due;
    is_other = true;
  }
  return is_other;
}

void CurveFit::weigh_fields(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                            MeasuredPoints& points, FittedPoints& fitted) {
  constexpr int most_turns = 3;
  if (n_field_data() == 0) return;
  for (int turn = 0; turn < most_turns; ++turn) {
    if (!find_scatter(stage, until, points, fitted.result) || !take_noise()) return;
    session_.log.say("  again, for the noise of the fields is another one than it was taken for");
    const std::vector<double> estimates = fitted.result.values();
    FitProblem problem = problem_of(stage, points, until, model_);
    for (std::size_t j = 0; j < estimates.size(); ++j) problem.parameters[j].start = estimates[j];
    fitted = fit_points(stage, points, until, from_one_start(settings), problem);
  }
  find_scatter(stage, until, points, fitted.result);
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
