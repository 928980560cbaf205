#include "postproc/curves/curve_misfit.h"

#include "physics/error.h"
#include "solver/calibration/calibration_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double rounding = 1e-6;  // of a range: a run's last displacement is not exact

const SampledCurve& model_of(const ModelCurves& models, const MeasuredPoints::Point& point) {
  return models.size() == 1 ? models.front() : models.at(point.specimen);
}

InputError zero_deviation(const SampledCurve& curve, std::size_t row) {
  return InputError(
      fmt::format("the standard deviation of \"{}\" at {:.4g} (SI), its point {}, is zero: its weight "
                  "would be infinite; give the deviation of the force sensor, or leave \"deviation\" out",
                  curve.name, curve.x[row], row + 1));
}

/// Mean of a curve over [middle - reach, middle + reach]; the value in the middle where reach is zero.
double mean_about(const SampledCurve& curve, double middle, double reach) {
  const double from = middle - reach, to = middle + reach;
  if (!(to > from)) return curve.at(middle);
  double x = from, y = curve.at(from), area = 0.0;
  const auto add = [&](double next_x, double next_y) {
    area += 0.5 * (y + next_y) * (next_x - x);
    x = next_x;
    y = next_y;
  };
  const auto first = std::ranges::upper_bound(curve.x, from) - curve.x.begin();
  for (auto i = static_cast<std::size_t>(first); i < curve.x.size() && curve.x[i] < to; ++i)
    add(curve.x[i], curve.y[i]);
  add(to, curve.at(to));
  return area / (to - from);
}

/// Half the way from the point before to the one after, of the same specimen.
double spacing_at(const MeasuredPoints& measured, std::size_t i) {
  const auto& points = measured.points;
  const std::size_t before = i > 0 && points[i - 1].specimen == points[i].specimen ? i - 1 : i,
                    after = i + 1 < points.size() && points[i + 1].specimen == points[i].specimen ? i + 1 : i;
  if (after == before) return 0.0;
  return std::abs(points[after].x - points[before].x) / static_cast<double>(after - before);
}

/// How far a point is from the nearest measured jump of its specimen, at which the model's curve is parted; a little
/// less, so that rounding does not reach over it. Infinite without one.
double room_in_branch(const MeasuredPoints& measured, const MeasuredPoints::Point& point) {
  double room = std::numeric_limits<double>::infinity();
  for (const MeasuredEvent& event : measured.events)
    if (event.kind == EventKind::jump && event.specimen == point.specimen)
      room = std::min(room, (1.0 - rounding) * std::abs(point.x - event.place));
  return room;
}

/// The points of all curves whose specimen and row are `wanted`; `from` and `to` for the message.
template <class Wanted>
MeasuredPoints points_of(const std::vector<const SampledCurve*>& curves, const Wanted& wanted, double from, double to) {
  MeasuredPoints measured{.points = {}, .noise_is_known = true, .rms = 0.0};
  for (std::size_t s = 0; s < curves.size(); ++s) {
    const SampledCurve& curve = *curves[s];
    measured.noise_is_known = measured.noise_is_known && !curve.deviation.empty();
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!wanted(s, i)) continue;
      const double deviation = curve.deviation.empty() ? 0.0 : curve.deviation[i];
      if (!curve.deviation.empty() && !(deviation > 0.0)) throw zero_deviation(curve, i);
      measured.points.push_back({s, curve.x[i], curve.y[i], deviation});
      measured.rms += curve.y[i] * curve.y[i];
    }
  }
  if (measured.points.empty()) {
    const bool negative = std::ranges::all_of(curves, [](const SampledCurve* curve) {
      return std::ranges::all_of(curve->x, [](double x) { return x <= 0.0; });
    });
    throw InputError(fmt::format("no measured point lies between {:.4g} and {:.4g} (SI){}", from, to,
                                 negative && to > 0.0 ? ": all measured displacements are negative, the computed ones "
                                                        "are not; turn their sign, and that of the forces"
                                                      : ""));
  }
  measured.rms = std::sqrt(measured.rms / static_cast<double>(measured.points.size()));
  return measured;
}

/// For each specimen the curve that its points are compared with.
ModelCurves moved_to_events(const ModelCurves& models, const MeasuredPoints& measured) {
  std::size_t n = models.size();
  for (const auto& point : measured.points) n = std::max(n, point.specimen + 1);
  ModelCurves moved;
  for (std::size_t s = 0; s < n; ++s)
    moved.push_back(with_jumps_as_measured(model_of(models, {.specimen = s}), measured.events, s));
  return moved;
}

std::optional<std::vector<double>> pointwise_residuals(const ModelCurves& models, const MeasuredPoints& measured) {
  std::vector<double> residuals;
  for (const auto& point : measured.points) {
    const SampledCurve& model = model_of(models, point);
    const double slack = rounding * (model.x.back() - model.x.front());
    if (point.x < model.x.front() - slack || point.x > model.x.back() + slack) return std::nullopt;
    residuals.push_back((model.at(point.x) - point.y) / measured.scale(point));
  }
  return residuals;
}

std::optional<std::vector<double>> averaged_pointwise(const ModelCurves& models, const MeasuredPoints& measured) {
  auto residuals = pointwise_residuals(models, measured);
  if (!residuals) return std::nullopt;
  for (std::size_t i = 0; i < residuals->size(); ++i) {
    const auto& point = measured.points[i];
    const SampledCurve& model = model_of(models, point);
    const double room = std::min(point.x - model.x.front(), model.x.back() - point.x);
    const double reach = std::min({spacing_at(measured, i), room, room_in_branch(measured, point)});
    if (reach > 0.0) (*residuals)[i] = (mean_about(model, point.x, reach) - point.y) / measured.scale(point);
  }
  return residuals;
}

/// `pointwise`: residuals of the points by curves for each specimen.
template <class Pointwise>
std::optional<std::vector<double>> with_events(const ModelCurves& models, const MeasuredPoints& measured,
                                               const Pointwise& pointwise) {
  if (measured.events.empty()) return pointwise(models, measured);
  auto residuals = pointwise(moved_to_events(models, measured), measured);
  if (!residuals) return std::nullopt;
  for_each_datum(measured.events, [&](const MeasuredEvent& event, const MeasuredFigure& figure) {
    residuals->push_back(residual_of(computed_event(event, model_of(models, {.specimen = event.specimen})), figure));
  });
  return residuals;
}

}  // namespace

void require_deviations(const std::vector<MeasuredCurve>& specimens) {
  for (const MeasuredCurve& specimen : specimens)
    for (std::size_t i = 0; i < specimen.curve.deviation.size(); ++i)
      if (!(specimen.curve.deviation[i] > 0.0)) throw zero_deviation(specimen.curve, i);
}

MeasuredPoints points_between(const std::vector<SampledCurve>& specimens, double from, double to) {
  std::vector<const SampledCurve*> curves;
  for (const SampledCurve& specimen : specimens) curves.push_back(&specimen);
  const auto wanted = [&](std::size_t s, std::size_t i) {
    return specimens[s].x[i] >= from && specimens[s].x[i] <= to;
  };
  return points_of(curves, wanted, from, to);
}

MeasuredPoints points_between(const std::vector<MeasuredCurve>& specimens, double from, double to,
                              const std::vector<double>& latest) {
  std::vector<const SampledCurve*> curves;
  std::vector<std::vector<double>> x;  // of the specimens
  for (const MeasuredCurve& specimen : specimens) {
    curves.push_back(&specimen.curve);
    x.push_back(specimen.of_specimen().x);
  }
  const auto wanted = [&](std::size_t s, std::size_t i) {
    return x[s][i] >= from && x[s][i] <= to && specimens[s].curve.x[i] <= latest[s];
  };
  return points_of(curves, wanted, from, to);
}

std::optional<std::vector<double>> residuals_of(const ModelCurves& models, const MeasuredPoints& measured) {
  return with_events(models, measured, pointwise_residuals);
}

std::optional<std::vector<double>> averaged_residuals_of(const ModelCurves& models, const MeasuredPoints& measured) {
  return with_events(models, measured, averaged_pointwise);
}

double rms_residual(const ModelCurves& models, const MeasuredPoints& measured) {
  const auto residuals = residuals_of(models, measured);
  if (!residuals) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const double r : *residuals) sum += r * r;
  return std::sqrt(sum / static_cast<double>(residuals->size()));
}

double relative_misfit(const std::vector<double>& residuals, const MeasuredPoints& measured) {
  double sum = 0.0;
  const std::size_t n = measured.points.size();
  for (std::size_t i = 0; i < n; ++i) sum += std::pow(residuals[i] * measured.scale(measured.points[i]), 2);
  return std::sqrt(sum / static_cast<double>(n)) / measured.rms;
}

std::vector<double> weights_by_scatter(const std::vector<double>& residuals, const MeasuredPoints& measured) {
  constexpr double alike = 1.2, most = 10.0;
  std::vector<double> scatter, n;
  for (std::size_t i = 0; i < measured.points.size(); ++i) {  // others may come behind
    const auto& point = measured.points[i];
    scatter.resize(std::max(scatter.size(), point.specimen + 1), 0.0);
    n.resize(scatter.size(), 0.0);
    scatter[point.specimen] += std::pow(residuals[i] * measured.scale(point), 2);
    n[point.specimen] += 1.0;
  }
  double largest = 0.0;
  for (std::size_t s = 0; s < scatter.size(); ++s) {
    scatter[s] = std::sqrt(scatter[s] / std::max(n[s], 1.0));
    largest = std::max(largest, scatter[s]);
  }
  std::vector<double> weights;
  double squares = 0.0;
  for (std::size_t s = 0; s < scatter.size(); ++s) {
    weights.push_back(1.0 / std::max(scatter[s], largest / most));
    squares += n[s] * weights[s] * weights[s];
  }
  if (scatter.size() < 2 || !(largest > 0.0) || !(largest > alike * std::ranges::min(scatter))) return {};
  for (double& weight : weights) weight /= std::sqrt(squares / static_cast<double>(measured.points.size()));
  return weights;
}

std::vector<std::vector<double>> set_up_errors(const ModelCurves& models, const MeasuredPoints& measured) {
  std::vector<std::vector<double>> columns(5);
  const ModelCurves moved = measured.events.empty() ? models : moved_to_events(models, measured);
  for (const auto& point : measured.points) {
    const SampledCurve& model = model_of(moved, point);
    const double low = model.x.front(), high = model.x.back();
    const double step = std::min(2e-3 * (high - low), room_in_branch(measured, point));
    const double scale = measured.scale(point);
    const double x = std::clamp(point.x, low, high), left = std::max(x - step, low), right = std::min(x + step, high);
    const double force = model.at(x), slope = (model.at(right) - model.at(left)) / (right - left);
    const double effects[] = {1.0, slope, slope * force, force, slope * x};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(effects[k] / scale);
  }
  for_each_datum(measured.events, [&](const MeasuredEvent& event, const MeasuredFigure& figure) {
    const ComputedEvent computed = computed_event(event, model_of(models, {.specimen = event.specimen}));
    const double force = computed.of(figure.figure), before = computed.force_before;
    const double of_force[] = {1.0, 0.0, 0.0, force, 0.0};
    const double of_displacement[] = {0.0, -1.0, -before, 0.0, -computed.displacement};
    const auto& effects = figure.figure == EventFigure::displacement ? of_displacement : of_force;
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(effects[k] / figure.deviation);
  });
  return columns;
}

double explaining_force_offset(const std::vector<double>& residuals, const std::vector<std::vector<double>>& errors) {
  return -explained_by(residuals, errors)[0];
}

bool contradicts_unloaded_start(const SampledCurve& curve, double force_offset) {
  constexpr double unloaded = 0.02, noticeable = 0.05;  // of the largest force
  double largest = 0.0;
  for (const double force : curve.y) largest = std::max(largest, std::abs(force));
  return !curve.y.empty() && std::abs(curve.y.front()) < unloaded * largest &&
         std::abs(force_offset) > noticeable * largest;
}

double rms_difference(const SampledCurve& model, const MeasuredPoints& measured, std::size_t specimen) {
  double sum = 0.0, n = 0.0;
  for (const auto& point : measured.points)
    if (point.specimen == specimen) {
      sum += std::pow(model.at(point.x) - point.y, 2);
      n += 1.0;
    }
  return n > 0.0 ? std::sqrt(sum / n) : 0.0;
}

}  // namespace pfdm
