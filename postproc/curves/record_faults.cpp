#include "postproc/curves/record_faults.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_origin = 0.02;  // of the straight part
constexpr double alike = 0.5;          // cosines beyond are no chance
constexpr double other_unit = 30.0;    // a first guess is hardly so far off, prefixes of units are a thousand apart

/// Whether the points of a specimen reach to what its record has of force: rows of slack tell no sign.
bool tell_force(const MeasuredPoints& measured, const MeasuredCurve& record, std::size_t specimen) {
  constexpr double share = 0.3;
  double reached = 0.0, largest = 0.0;
  for (const MeasuredPoints::Point& point : measured.points)
    if (point.specimen == specimen) reached = std::max(reached, std::abs(point.y));
  for (const double force : record.curve.y) largest = std::max(largest, std::abs(force));
  return reached > share * largest;
}

/// The first rows of a curve, up to 60 % of its greatest force.
struct Rise {
  std::size_t end = 0, peak = 0;  ///< the row behind them; that of the greatest force
};
Rise rise_of(const SampledCurve& curve) {
  constexpr double share = 0.6;
  Rise rise{.end = 0, .peak = static_cast<std::size_t>(std::ranges::max_element(curve.y) - curve.y.begin())};
  while (rise.end < rise.peak && curve.y[rise.end] <= share * curve.y[rise.peak]) ++rise.end;
  return rise;
}

/// Where a least-squares line meets zero, and the standard error of that for a standard deviation of 1 of all y.
struct Zero {
  double zero = 0.0, spread = 0.0;
};
/// Of two points too; nothing where they do not rise.
std::optional<Zero> line_through(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0.0) || !(xy > 0.0)) return std::nullopt;
  const double zero = mean_x - mean_y * xx / xy;
  return Zero{.zero = zero, .spread = std::sqrt(1.0 / n + (zero - mean_x) * (zero - mean_x) / xx) * xx / xy};
}

}  // namespace

std::optional<Slack> slack_at_start(const SampledCurve& measured) {
  constexpr double unloaded = 0.02, rise_from = 0.05, rise_to = 0.4, significant = 4.0;
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(measured.y) - measured.y.begin());
  const double largest = measured.y.empty() ? 0.0 : measured.y[peak];
  std::vector<double> x, y;  // of the rise
  Slack slack{.from = rise_from * largest, .to = rise_to * largest};
  std::size_t first = 0;
  while (first < peak && measured.x[first] < 0.0) ++first;
  for (std::size_t i = first; i < peak && measured.y[i] <= slack.to; ++i) {
    if (measured.y[i] < slack.from) continue;
    x.push_back(measured.x[i]);
    y.push_back(measured.y[i]);
  }
  const auto line = straight_line(x, y, 0.0);
  if (!line) return std::nullopt;
  slack.origin = line->zero;
  slack.error = line->zero_error;
  for (std::size_t i = first; i < peak && measured.x[i] < slack.origin; ++i, ++slack.n_rows) {
    if (std::abs(measured.y[i]) > unloaded * largest) return std::nullopt;
    slack.until = measured.x[i];
  }
  const double length = slack.origin - measured.x[first];
  const bool is_slack = slack.n_rows >= 3 && length > significant * slack.error &&
                        length > least_origin * (measured.x[peak] - measured.x[first]);
  return is_slack ? std::optional(slack) : std::nullopt;
}

std::optional<std::string> doubt_of_origin(const SampledCurve& measured, const SampledCurve& computed, double from,
                                           double to) {
  if (const auto slack = slack_at_start(measured))
    return fmt::format(
        "{} begins with slack: {} rows up to {} are at zero force, and the rise after them meets it at {} (standard "
        "error {}); toe = [\"{}\", \"{}\"] of [experiment] makes that the origin",
        measured.name, slack->n_rows, quantity_text(slack->until, "m", 3), quantity_text(slack->origin, "m"),
        quantity_text(slack->error, "m", 2), quantity_text(slack->from, "N", 3), quantity_text(slack->to, "N", 3));
  const auto missed = missed_origin(measured, computed, from, to);
  return missed ? std::optional(missed_origin_text(*missed, measured.name)) : std::nullopt;
}

ForceScale force_scale(const ModelCurves& models, const MeasuredPoints& measured, std::size_t specimen) {
  const SampledCurve& model = models.size() == 1 ? models.front() : models.at(specimen);
  double both = 0.0, of_model = 0.0, of_record = 0.0;
  for (const MeasuredPoints::Point& point : measured.points) {
    if (point.specimen != specimen) continue;
    const double computed = model.at(point.x);
    both += computed * point.y;
    of_model += computed * computed;
    of_record += point.y * point.y;
  }
  if (!(of_model > 0.0) || !(of_record > 0.0)) return {};
  return {.alikeness = both / std::sqrt(of_model * of_record), .factor = both / of_model};
}

void require_same_sign(const ModelCurves& models, const MeasuredPoints& measured,
                       const std::vector<MeasuredCurve>& specimens) {
  for (std::size_t s = 0; s < specimens.size(); ++s)
    if (tell_force(measured, specimens[s], s) && force_scale(models, measured, s).alikeness < -alike)
      throw InputError(
          fmt::format("the forces of \"{}\" have the other sign than the computed ones of the first guess; "
                      "factor = {:g} turns them, as in force = {{ ..., factor = {:g} }} of [[experiment.specimens]]",
                      specimens[s].curve.name, -specimens[s].force_factor, -specimens[s].force_factor));
}

std::vector<std::string> doubts_of_unit(const ModelCurves& models, const MeasuredPoints& measured,
                                        const std::vector<MeasuredCurve>& specimens) {
  std::vector<std::string> doubts;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    const ForceScale scale = force_scale(models, measured, s);
    if (!tell_force(measured, specimens[s], s)) continue;
    if (!(scale.alikeness > alike) || (scale.factor < other_unit && scale.factor > 1.0 / other_unit)) continue;
    doubts.push_back(
        fmt::format("the forces of {} are {:.2g} times the computed ones of the first guess: the unit or the factor of "
                    "its force in "
                    "[[experiment.specimens]], the width of the model, or a first guess that is far off",
                    specimens[s].curve.name, scale.factor));
  }
  return doubts;
}

std::optional<std::string> doubt_of_rise(const std::vector<MeasuredCurve>& specimens, std::size_t s,
                                         const SampledCurve& computed, double scatter) {
  constexpr double noticeable = 0.1, significant = 4.0;
  const SampledCurve measured = specimens[s].of_specimen();
  const Rise rise = rise_of(measured);
  std::vector<double> x, y, model;
  for (std::size_t i = 0; i < rise.end; ++i) {
    if (measured.x[i] < computed.x.front() || measured.x[i] > computed.x.back()) continue;
    x.push_back(measured.x[i]);
    y.push_back(measured.y[i]);
    model.push_back(computed.at(x.back()));
  }
  const auto line = line_through(x, y), computed_line = line_through(x, model);
  if (!line) return std::nullopt;
  const double apart = line->zero - (computed_line ? computed_line->zero : computed.x.front());
  const double least = noticeable * (measured.x[rise.peak] - measured.x.front());
  if (!(std::abs(apart) > std::max(significant * scatter * line->spread, least))) return std::nullopt;
  return fmt::format(
      "the rise of {} ({} rows) meets zero force {} {} that of the computed curve: an offset; offset = \"{}\" in its "
      "[[experiment.specimens]] takes it out, and as key = \"experiment.specimens[{}].offset\" of [[fit.parameters]] "
      "it "
      "is estimated",
      measured.name, x.size(), quantity_text(std::abs(apart), "m", 3), apart > 0.0 ? "behind" : "before",
      quantity_text(specimens[s].set_up.offset + apart, "m", 3), s);
}

std::optional<std::string> doubt_of_specimens(const std::vector<double>& residuals, const MeasuredPoints& measured,
                                              const std::vector<MeasuredCurve>& specimens) {
  constexpr double most = 0.7;
  std::vector<SampledCurve> left(specimens.size());  // residuals as forces
  for (std::size_t i = 0; i < measured.points.size(); ++i) {
    const MeasuredPoints::Point& point = measured.points[i];
    left[point.specimen].x.push_back(point.x);
    left[point.specimen].y.push_back(residuals[i] * measured.scale(point));
  }
  if (left.size() < 2 || std::ranges::any_of(left, [](const SampledCurve& r) { return r.x.empty(); })) return {};
  const auto n = static_cast<double>(left.size());
  double all = 0.0, apart = 0.0;
  for (const double x : left.front().x) {
    if (std::ranges::any_of(left, [x](const SampledCurve& r) { return x < r.x.front() || x > r.x.back(); })) continue;
    double sum = 0.0, squares = 0.0;
    for (const SampledCurve& r : left) {
      sum += r.at(x);
      squares += r.at(x) * r.at(x);
    }
    all += squares;
    apart += (squares - sum * sum / n) * n / (n - 1.0);
  }
  if (!(apart > most * all)) return std::nullopt;
  return fmt::format(
      "the specimens disagree: most of what the model leaves is how far they lie apart, {} rms; fit each by itself, a "
      "case each, whose estimates show how much specimens scatter",
      quantity_text(std::sqrt(apart / n / static_cast<double>(left.front().x.size())), "N", 3));
}

}  // namespace pfdm
