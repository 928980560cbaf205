#include "postproc/curves/comparison.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr int n_points = 401;       // over the common range
constexpr int n_slope_points = 51;  // over that of the stiffness

void require_curve(const SampledCurve& curve) {
  if (curve.x.size() < 2) throw InputError(fmt::format("the curve \"{}\" has fewer than two points", curve.name));
  for (std::size_t i = 1; i < curve.x.size(); ++i)
    if (curve.x[i] < curve.x[i - 1])
      throw InputError(fmt::format(
          "the curve \"{}\" decreases in displacement at its point {}: remove unloading, and sort the points",
          curve.name, i + 1));
}

double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto above = std::upper_bound(xs.begin(), xs.end(), x);
  if (above == xs.begin()) return ys.front();
  if (above == xs.end()) return ys.back();
  const auto i = static_cast<std::size_t>(above - xs.begin());
  return ys[i - 1] + (x - xs[i - 1]) / (xs[i] - xs[i - 1]) * (ys[i] - ys[i - 1]);
}

double mean_at(const std::vector<SampledCurve>& specimens, double x) {
  double sum = 0.0;
  for (const SampledCurve& s : specimens) sum += s.at(x);
  return sum / static_cast<double>(specimens.size());
}

double deviation_at(const std::vector<SampledCurve>& specimens, double mean, double x) {
  if (specimens.size() == 1) return interpolated(specimens[0].x, specimens[0].deviation, x);
  double sum = 0.0;
  for (const SampledCurve& s : specimens) sum += std::pow(s.at(x) - mean, 2);
  return std::sqrt(sum / static_cast<double>(specimens.size() - 1));
}

std::pair<double, double> common_range(const SampledCurve& model, const std::vector<SampledCurve>& specimens) {
  double from = model.x.front(), to = model.x.back();
  for (const SampledCurve& s : specimens) {
    from = std::max(from, s.x.front());
    to = std::min(to, s.x.back());
  }
  if (!(from < to))
    throw InputError(
        fmt::format("the computed curve goes from {:.4g} to {:.4g} (SI): no range is common to it and to "
                    "all measured ones; are the units right?",
                    model.x.front(), model.x.back()));
  return {from, to};
}

double slope_of(const SampledCurve& curve, double from, double to) {
  const double middle = 0.5 * (from + to);
  double moment = 0.0, inertia = 0.0;
  for (int i = 0; i < n_slope_points; ++i) {
    const double x = from + (to - from) * i / (n_slope_points - 1);
    moment += (x - middle) * curve.at(x);
    inertia += (x - middle) * (x - middle);
  }
  return moment / inertia;
}

}  // namespace

double SampledCurve::at(double where) const { return interpolated(x, y, where); }

SampledCurve driven_curve(const SampledCurve& followed) {
  SampledCurve driven{.name = followed.name, .x = {}, .y = {}};
  for (std::size_t i = 0; i < followed.x.size(); ++i) {
    const double x = followed.x[i], y = followed.y[i];
    if (const bool falls_back = !driven.x.empty() && x < driven.x.back(); !falls_back) {
      if (i > 0 && followed.x[i - 1] < driven.x.back()) {  // it comes back from a fall
        const double last = driven.x.back(), share = (last - followed.x[i - 1]) / (x - followed.x[i - 1]);
        driven.x.push_back(last);
        driven.y.push_back(followed.y[i - 1] + share * (y - followed.y[i - 1]));
      }
      driven.x.push_back(x);
      driven.y.push_back(y);
    }
    if (followed.first_debonding == i) driven.first_debonding = driven.x.size() - 1;
  }
  return driven;
}

ComparedCurves compare_curves(const SampledCurve& model, const std::vector<SampledCurve>& specimens) {
  if (specimens.empty()) throw InputError("there is no measured curve to compare with");
  require_curve(model);
  for (const SampledCurve& s : specimens) require_curve(s);
  const auto [from, to] = common_range(model, specimens);
  const bool has_band = specimens.size() > 1 || !specimens[0].deviation.empty();
  ComparedCurves compared;
  double sum = 0.0;
  int within = 0;
  for (int i = 0; i < n_points; ++i) {
    const double x = from + (to - from) * i / (n_points - 1), y = model.at(x), measured = mean_at(specimens, x);
    compared.x.push_back(x);
    compared.model.push_back(y);
    compared.measured.push_back(measured);
    if (has_band) {
      compared.deviation.push_back(deviation_at(specimens, measured, x));
      if (std::abs(y - measured) <= 2.0 * compared.deviation.back()) ++within;
    }
    sum += std::pow(y - measured, 2);
    compared.largest_measured = std::max(compared.largest_measured, std::abs(measured));
    if (std::abs(y - measured) <= compared.largest) continue;
    compared.largest = std::abs(y - measured);
    compared.x_of_largest = x;
  }
  compared.rms = std::sqrt(sum / n_points);
  if (has_band) compared.share_in_band = static_cast<double>(within) / n_points;
  return compared;
}

CurveFigures figures_of(const SampledCurve& curve, double from, double to, double stiffness_from, double stiffness_to) {
  SampledCurve part{.name = curve.name, .x = {from}, .y = {curve.at(from)}};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!(curve.x[i] > from && curve.x[i] < to)) continue;
    part.x.push_back(curve.x[i]);
    part.y.push_back(curve.y[i]);
  }
  part.x.push_back(to);
  part.y.push_back(curve.at(to));
  const auto peak = std::max_element(part.y.begin(), part.y.end());
  CurveFigures figures;
  figures.peak_force = *peak;
  figures.displacement_at_peak = part.x[peak - part.y.begin()];
  for (std::size_t i = 1; i < part.x.size(); ++i)
    figures.work += 0.5 * (part.y[i] + part.y[i - 1]) * (part.x[i] - part.x[i - 1]);
  figures.initial_stiffness = slope_of(part, stiffness_from, stiffness_to);
  return figures;
}

std::optional<double> onset_of(const SampledCurve& curve, double threshold) {
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (curve.y[i] > threshold) return curve.x[i];
  return std::nullopt;
}

}  // namespace pfdm
