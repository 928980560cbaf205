// What speaks against measured displacement fields of a fit: member functions of curve_fit_at_work.h.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pfdm {

bool CurveFit::finer_explains(const DoneStage& done, const FitFindings& found, std::size_t field) {
  if (!finer_ || &done.stage != &job_.settings.stages.back()) return false;
  std::vector<double> values = values_;  // as the finer case would have them
  for (std::size_t j = 0; j < done.stage.parameters.size(); ++j)
    if (const double move = found.parameters[j].moved_by_finer; std::isfinite(move))
      values[done.stage.parameters[j]] += move;
  CurveModel model(finer_->file, parameters_, job_.read_curve, job_.read_history, runs_);
  const auto differences = field_differences(values, done.until, done.points.events, model);
  if (!differences) return false;
  return !scatter_of(job_.fields.fields[field], fields_[field].frames, without_motion(field, *differences))
              .is_long_ranged;
}

void CurveFit::doubt_fields(const DoneStage& done, FitFindings& found) {
  if (n_field_data() == 0) return;
  const auto differences = field_differences(values_, done.until, done.points.events, model_);
  if (!differences) return;
  auto row = static_cast<std::ptrdiff_t>(done.points.n_data());
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    if (fields_[k].frames.empty()) continue;
    const std::ptrdiff_t first = row;
    row += static_cast<std::ptrdiff_t>(n_field_data(k));
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

bool CurveFit::doubt_scale(const DoneStage& done, std::size_t k, const std::vector<Eigen::MatrixXd>& differences,
                           std::pair<std::ptrdiff_t, std::ptrdiff_t> rows, FitFindings& found) const {
  constexpr double surely = 3.3, least = 0.002;
  constexpr double unmoved = 0.01;  // standard deviations, all residuals together, by a standard error of a parameter
  const MeasuredField& field = job_.fields.fields[k];
  const StageField& of_stage = fields_[k];
  std::vector<double> computed, residuals;
  for (std::size_t i = 0; i < of_stage.frames.size(); ++i) {
    const Eigen::MatrixXd of_run = differences[i] + measured_of(field, field.frames[of_stage.frames[i]]);
    for (const auto& [from, to] : {std::pair(&differences[i], &residuals), std::pair(&of_run, &computed)}) {
      const Eigen::VectorXd reduced = of_stage.motions[i].reduced(*from) / of_stage.deviation;
      to->insert(to->end(), reduced.begin(), reduced.end());
    }
  }
  std::vector<std::vector<double>> by_parameters;
  for (Eigen::Index j = 0; j < done.result.derivatives.cols(); ++j) {
    const auto column = done.result.derivatives.col(j).segment(rows.first, rows.second - rows.first);
    if (column.norm() * std::sqrt(done.result.inverse_normal(j, j)) > unmoved)
      by_parameters.emplace_back(column.begin(), column.end());
  }
  std::vector<std::vector<double>> columns{computed};
  columns.insert(columns.end(), by_parameters.begin(), by_parameters.end());
  const double scale = explained_by(residuals, columns)[0], left = rms_left_by(residuals, columns);
  // Its effect beside those of the parameters, over the noise.
  const double effect = rms_left_by(computed, by_parameters) * std::sqrt(static_cast<double>(computed.size()));
  const double error = std::max(left, 1.0) / effect;
  if (!(std::abs(scale) > least && std::abs(scale) > surely * error)) return false;
  question(found,
           fmt::format("displacements of field \"{}\" that were {:.3g} times as large would leave less: their scale is "
                       "{:.2g} standard errors off; see its \"unit\", \"pixel\" and \"factor\"",
                       field.name, 1.0 / (1.0 - scale), std::abs(scale) / error));
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

}  // namespace pfdm
