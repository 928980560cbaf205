#include "postproc/curves/measured_curve.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double chance = 1e-3;             // of noise alone to move the origin significantly
constexpr double noticeable_origin = 0.02;  // of the straight part

SampledCurve rows_of(const SampledCurve& curve, const std::vector<std::size_t>& rows) {
  SampledCurve part{.name = curve.name, .x = {}, .y = {}};
  for (const std::size_t i : rows) {
    part.x.push_back(curve.x[i]);
    part.y.push_back(curve.y[i]);
    if (!curve.deviation.empty()) part.deviation.push_back(curve.deviation[i]);
  }
  return part;
}

/// The largest displacements so far, and what lies less than `jitter` below them before a larger one comes.
std::vector<std::size_t> envelope_of(const std::vector<double>& x, double jitter) {
  std::vector<std::size_t> kept;
  for (std::size_t top = 0; top < x.size();) {
    kept.push_back(top);
    std::size_t next = top + 1;
    double least = x[top];
    for (; next < x.size() && x[next] < x[top]; ++next) least = std::min(least, x[next]);
    if (least >= x[top] - jitter)
      for (std::size_t i = top + 1; i < next; ++i) kept.push_back(i);
    top = next;
  }
  return kept;
}

void take_envelope(MeasuredCurve& measured, double jitter) {
  const std::vector<std::size_t> kept = envelope_of(measured.curve.x, jitter);
  if (kept.size() == measured.curve.x.size()) return;
  measured.done.push_back(fmt::format("unloading loops: {} of {} rows left out", measured.curve.x.size() - kept.size(),
                                      measured.curve.x.size()));
  measured.curve = rows_of(measured.curve, kept);
}

/// Whether the rows go down from zero, and are in order with the other sign.
bool has_other_sign(const std::vector<double>& x, double jitter) {
  const auto [least, most] = std::ranges::minmax(x);
  std::vector<double> turned;
  for (const double value : x) turned.push_back(-value);
  const std::vector<std::size_t> kept = envelope_of(turned, jitter);
  return -least > jitter && most <= 0.1 * -least && 2 * kept.size() > x.size() && turned[kept.back()] > 0.9 * -least;
}

InputError other_sign(const std::vector<double>& x) {
  return InputError(fmt::format(
      "the displacements go down, from {:.4g} to {:.4g} m: their sign is not the model's; factor = -1 turns "
      "a column, as in displacement = {{ ..., factor = -1 }}, and that of the force likewise",
      x.front(), x.back()));
}

/// Whether the rows go down from the greatest displacement to the least.
bool runs_backwards(const std::vector<double>& x, double jitter) {
  const auto [least, most] = std::ranges::minmax(x);
  const std::vector<double> turned(x.rbegin(), x.rend());
  const bool is_turned = x.front() >= most - jitter && x.back() <= least + jitter && most - least > jitter;
  return is_turned && 2 * envelope_of(turned, jitter).size() > x.size();
}

InputError backwards(const std::vector<double>& x) {
  return InputError(
      fmt::format("the displacements fall from the first row, {}, to the last, {}: the rows run backwards; "
                  "sort the file by displacement",
                  quantity_text(x.front(), "m"), quantity_text(x.back(), "m")));
}

InputError falling(const std::vector<double>& x, double jitter, double moved) {
  std::size_t row = 1;
  while (!(x[row] < x[row - 1])) ++row;
  double top = x.front(), depth = 0.0;
  for (const double value : x) {
    top = std::max(top, value);
    depth = std::max(depth, top - value);
  }
  const std::string allowed = jitter > 0.0 ? fmt::format(", and a jitter of {} does not cover moves of {}",
                                                         quantity_text(jitter, "m"), quantity_text(moved, "m"))
                                           : "";
  return InputError(fmt::format(
      "the displacements decrease, first from row {} ({}) to the next ({}), and lie up to {} below earlier ones{}; set "
      "loops = \"envelope\" to leave unloading out, or jitter to the largest noise",
      row, quantity_text(x[row - 1], "m", 6), quantity_text(x[row], "m", 6), quantity_text(depth, "m"), allowed));
}

void take_jitter(MeasuredCurve& measured, double jitter) {
  std::vector<double>& x = measured.curve.x;
  if (std::ranges::is_sorted(x)) return;
  const std::vector<double> smooth = nearest_not_falling(x);
  double largest = 0.0;
  std::size_t n_moved = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (smooth[i] != x[i]) ++n_moved;
    largest = std::max(largest, std::abs(smooth[i] - x[i]));
  }
  if (!(largest <= jitter)) throw falling(x, jitter, largest);
  x = smooth;
  measured.done.push_back(fmt::format("jitter: {} of {} displacements moved, by {} at most", n_moved, x.size(),
                                      quantity_text(largest, "m")));
}

/// The first row of the straight part, and the one after its last.
std::pair<std::size_t, std::size_t> rows_between(const SampledCurve& curve, const Toe& toe) {
  const std::vector<double>& along = toe.of_force ? curve.y : curve.x;
  const auto first = std::ranges::find_if(along, [&](double value) { return value >= toe.from; });
  const auto last = std::find_if(first, along.end(), [&](double value) { return value > toe.to; });
  return {static_cast<std::size_t>(first - along.begin()), static_cast<std::size_t>(last - along.begin())};
}

void take_toe(MeasuredCurve& measured, const Toe& toe) {
  SampledCurve& curve = measured.curve;
  const auto [first, last] = rows_between(curve, toe);
  const auto begin = static_cast<std::ptrdiff_t>(first), end = static_cast<std::ptrdiff_t>(last);
  const auto line = straight_line({curve.x.begin() + begin, curve.x.begin() + end},
                                  {curve.y.begin() + begin, curve.y.begin() + end}, measured.set_up.force_offset);
  if (!line)
    throw InputError(
        fmt::format("toe: {} rows lie between {}; a straight part that rises needs three at two displacements",
                    last - first, quantities_text({toe.from, toe.to}, toe.of_force ? "N" : "m", " and ")));
  std::vector<std::size_t> kept;
  for (std::size_t i = first; i < curve.x.size(); ++i) kept.push_back(i);
  curve = rows_of(curve, kept);
  for (double& x : curve.x) x -= line->zero;
  measured.origin = line->zero;
  measured.done.push_back(fmt::format(
      "toe: the straight part of {} rows, {}, meets zero force at {} (standard error {}), the new origin; {} rows "
      "before it left out",
      line->n_points, quantity_text(line->slope, "N/m", 5), quantity_text(line->zero, "m"),
      quantity_text(line->zero_error, "m", 2), first));
}

}  // namespace

SampledCurve MeasuredCurve::of_specimen() const {
  if (set_up == SetUp{}) return curve;
  SampledCurve specimen = curve;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    specimen.y[i] -= set_up.force_offset;
    specimen.x[i] -= set_up.offset + set_up.compliance * specimen.y[i];
  }
  specimen.x = nearest_not_falling(specimen.x);
  return specimen;
}

std::vector<std::string> MeasuredCurve::treatment() const {
  std::vector<std::string> all = done;
  if (set_up.offset != 0.0) all.push_back(fmt::format("offset: {}", quantity_text(set_up.offset, "m")));
  if (set_up.force_offset != 0.0)
    all.push_back(fmt::format("force_offset: {}", quantity_text(set_up.force_offset, "N")));
  if (set_up.compliance != 0.0) all.push_back(fmt::format("compliance: {}", quantity_text(set_up.compliance, "m/N")));
  return all;
}

MeasuredCurve prepared(SampledCurve recorded, const Preparation& preparation, const SetUp& set_up) {
  MeasuredCurve measured{.as_recorded = recorded, .curve = std::move(recorded), .set_up = set_up};
  if (has_other_sign(measured.curve.x, preparation.jitter)) throw other_sign(measured.curve.x);
  if (runs_backwards(measured.curve.x, preparation.jitter)) throw backwards(measured.curve.x);
  if (preparation.envelope) take_envelope(measured, preparation.jitter);
  take_jitter(measured, preparation.jitter);
  if (preparation.toe) take_toe(measured, *preparation.toe);
  return measured;
}

SampledCurve as_recorded(const SampledCurve& computed, const SetUp& set_up) {
  if (set_up == SetUp{}) return computed;
  SampledCurve recorded{.name = computed.name, .x = {}, .y = {}};
  const auto add = [&](double u, double F) {
    recorded.x.push_back(u + set_up.offset + set_up.compliance * F);
    recorded.y.push_back(F + set_up.force_offset);
  };
  const std::size_t second =
      static_cast<std::size_t>(std::ranges::upper_bound(computed.x, computed.x.front()) - computed.x.begin());
  if (second < computed.x.size()) {
    const double reach = computed.x.back() - computed.x.front();
    const double slope = (computed.y[second] - computed.y[0]) / (computed.x[second] - computed.x[0]);
    add(computed.x[0] - reach, computed.y[0] - slope * reach);
  }
  if (computed.first_debonding) recorded.first_debonding = recorded.x.size() + *computed.first_debonding;
  for (std::size_t i = 0; i < computed.x.size(); ++i) add(computed.x[i], computed.y[i]);
  return driven_curve(recorded);
}

std::vector<double> nearest_not_falling(const std::vector<double>& values) {
  struct Block {
    double mean;
    std::size_t n;
  };
  std::vector<Block> blocks;
  for (const double value : values) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks.back().mean < blocks[blocks.size() - 2].mean) {
      const Block last = blocks.back();
      blocks.pop_back();
      Block& before = blocks.back();
      const double n = static_cast<double>(before.n + last.n);
      before = {before.mean + (last.mean - before.mean) * static_cast<double>(last.n) / n, before.n + last.n};
    }
  }
  std::vector<double> result;
  for (const Block& block : blocks) result.insert(result.end(), block.n, block.mean);
  return result;
}

std::optional<StraightLine> straight_line(const std::vector<double>& x, const std::vector<double>& y, double zero_y) {
  const auto n = static_cast<double>(x.size());
  if (x.size() < 3) return std::nullopt;
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, scatter = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += std::pow(x[i] - mean_x, 2);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  if (!(xx > 0.0) || !(slope > 0.0)) return std::nullopt;
  for (std::size_t i = 0; i < x.size(); ++i) scatter += std::pow(y[i] - mean_y - slope * (x[i] - mean_x), 2);
  const double zero = mean_x - (mean_y - zero_y) / slope;
  const double error = std::sqrt(scatter / (n - 2.0) * (1.0 / n + std::pow(zero - mean_x, 2) / xx)) / slope;
  return StraightLine{.slope = slope, .zero = zero, .zero_error = error, .n_points = x.size()};
}

std::optional<MissedOrigin> missed_origin(const SampledCurve& measured, const SampledCurve& computed, double from,
                                          double to) {
  std::vector<double> x, y, model;
  for (std::size_t i = 0; i < measured.x.size(); ++i) {
    if (measured.x[i] < std::max(from, computed.x.front()) || measured.x[i] > std::min(to, computed.x.back())) continue;
    x.push_back(measured.x[i]);
    y.push_back(measured.y[i]);
    model.push_back(computed.at(measured.x[i]));
  }
  const auto line = straight_line(x, y, 0.0), computed_line = straight_line(x, model, 0.0);
  if (!line || !computed_line) return std::nullopt;
  const double apart = std::abs(line->zero - computed_line->zero);
  const boost::math::students_t t(static_cast<double>(line->n_points) - 2.0);
  const double allowed = boost::math::quantile(boost::math::complement(t, 0.5 * chance)) * line->zero_error;
  if (!(apart > allowed && apart > noticeable_origin * (to - from))) return std::nullopt;
  return MissedOrigin{.measured = line->zero, .error = line->zero_error, .computed = computed_line->zero};
}

std::string missed_origin_text(const MissedOrigin& missed, const std::string& specimen) {
  return fmt::format(
      "the straight part of {} meets zero force at {} (standard error {}), that of the computed curve at {}: "
      "an offset or a toe; see offset, force_offset and toe of [experiment]",
      specimen, quantity_text(missed.measured, "m", 3), quantity_text(missed.error, "m", 2),
      quantity_text(missed.computed, "m", 3));
}

}  // namespace pfdm
