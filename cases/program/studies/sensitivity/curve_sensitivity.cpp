#include "cases/program/studies/sensitivity/curve_sensitivity.h"

#include "cases/program/studies/sensitivity/curve_peak.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

constexpr double share_of_doubt = 0.05, least_doubt = 0.01;

/// ln(plus/minus), over which a power law is straight; of numbers that are not of one sign their difference over
/// `base`.
double logarithmic_difference(double plus, double minus, double base) {
  const bool of_one_sign = plus * base > 0.0 && minus * base > 0.0;
  return of_one_sign ? std::log(plus / minus) : (plus - minus) / base;
}

/// By the central differences with both steps; `hidden`: what of the difference of two values may be none.
Elasticity by_differences(double base, const std::array<double, 4>& y, double step, double hidden = 0.0) {
  const auto by = [&](double plus, double minus, double h) {
    return logarithmic_difference(plus, minus, base) / std::log((1.0 + h) / (1.0 - h));
  };
  const double whole = by(y[0], y[1], step), half = by(y[2], y[3], step / 2.0);
  const double open = std::abs(hidden / base) / std::log((1.0 + step) / (1.0 - step));
  return {.value = whole, .error = std::max(std::abs(whole - half), open)};
}

/// A quantity of an event, by polynomials of two orders, and how far it may be off because steps have a length.
struct Reading {
  double value = 0.0, coarser = 0.0, hidden = 0.0;
};

/// The steeper side of a row, of both branches beside it [N/m].
double steepest(const SampledCurve& curve, std::size_t row) {
  double most = 0.0;
  for (std::size_t i = row > 0 ? row - 1 : 0; i < std::min(row + 1, curve.x.size() - 1); ++i)
    if (curve.x[i + 1] > curve.x[i])
      most = std::max(most, std::abs((curve.y[i + 1] - curve.y[i]) / (curve.x[i + 1] - curve.x[i])));
  return most;
}

std::vector<Reading> readings_of_peak(const SampledCurve& curve, const ComputedEvent& computed) {
  const CurvePeak peak(curve, CurveBranches(curve), computed.after);
  const auto [place, coarser] = peak.places();
  const double off = peak.shape() == CurvePeak::Shape::row ? computed.step / std::sqrt(12.0) : 0.0;
  return {{place.x, coarser.x, off}, {place.y, coarser.y, off * steepest(curve, computed.after)}};
}

std::vector<Reading> readings_of(const BaseEvent& event, const SampledCurve& curve, bool& is_there) {
  const ComputedEvent computed = computed_event(event.event, curve);
  is_there = is_there && computed.is_there;
  if (event.event.kind == EventKind::greatest_force && computed.is_there) return readings_of_peak(curve, computed);
  const CurveBranches branches(curve);
  const double place = computed.step / std::sqrt(12.0);
  std::vector<Reading> readings;
  for (const EventQuantity& quantity : event.quantities) {
    const double value = computed.of(quantity.figure);
    Reading reading{.value = value, .coarser = value, .hidden = place};
    if (quantity.figure != EventFigure::displacement)
      reading.hidden *= branches.slope(quantity.figure == EventFigure::force_after ? computed.after : computed.before);
    readings.push_back(reading);
  }
  return readings;
}

BaseEvent base_event(const SampledCurve& base, EventKind kind, std::optional<int> number) {
  BaseEvent found{.event = {.kind = kind, .number = number}, .displacement = 0.0, .quantities = {}};
  const ComputedEvent computed = computed_event(found.event, base);
  found.displacement = computed.displacement;
  const auto add = [&](EventFigure figure) { found.quantities.push_back({figure, computed.of(figure)}); };
  add(EventFigure::displacement);
  if (kind == EventKind::greatest_force) {
    add(EventFigure::force);
  } else {
    add(EventFigure::force_before);
    add(EventFigure::force_after);
  }
  bool is_there = computed.is_there;
  const std::vector<Reading> readings = readings_of(found, base, is_there);
  for (std::size_t k = 0; k < readings.size(); ++k) found.quantities[k].value = readings[k].value;
  return found;
}

}  // namespace

double least_force(const SampledCurve& curve) {
  constexpr double share = 0.01;
  double largest = 0.0;
  for (const double force : curve.y) largest = std::max(largest, std::abs(force));
  return share * largest;
}

bool Elasticity::is_doubtful() const {
  return is_known() && !(error <= std::max(share_of_doubt * std::abs(value), least_doubt));
}

std::vector<Elasticity> elasticities(const SampledCurve& base, const CurvesAround& around) {
  std::vector<CurveBranches> branches;
  for (const SampledCurve& curve : around.curves) branches.emplace_back(curve);
  const CurveBranches own(base);
  const double least = least_force(base);
  std::vector<Elasticity> found(base.x.size());
  for (std::size_t i = 0; i < base.x.size(); ++i) {
    if (std::abs(base.y[i]) < least) continue;
    const auto here = own.at(base.x[i]);
    std::array<double, 4> values{};
    bool are_there = here.has_value();
    for (std::size_t k = 0; k < values.size() && are_there; ++k) {
      const auto there = branches[k].at(base.x[i]);
      are_there = there && there->branch == here->branch;
      if (are_there) values[k] = there->y;
    }
    if (are_there) found[i] = by_differences(base.y[i], values, around.step);
  }
  return found;
}

std::size_t n_jumps(const SampledCurve& curve) {
  int n = 0;
  while (computed_event({.kind = EventKind::jump, .number = n + 1}, curve).is_there) ++n;
  return static_cast<std::size_t>(n);
}

std::vector<BaseEvent> events_of(const SampledCurve& base) {
  std::vector<BaseEvent> events;
  const auto add = [&](EventKind kind, std::optional<int> number) {
    if (computed_event({.kind = kind, .number = number}, base).is_there)
      events.push_back(base_event(base, kind, number));
  };
  add(EventKind::greatest_force, std::nullopt);
  for (int k = 1; k <= static_cast<int>(n_jumps(base)); ++k) add(EventKind::jump, k);
  add(EventKind::first_debonding, std::nullopt);
  return events;
}

std::vector<Elasticity> elasticities(const BaseEvent& event, const CurvesAround& around) {
  std::array<std::vector<Reading>, 4> readings;
  bool are_there = true;
  for (std::size_t k = 0; k < readings.size(); ++k) readings[k] = readings_of(event, around.curves[k], are_there);
  std::vector<Elasticity> found(event.quantities.size());
  if (!are_there) return found;
  for (std::size_t q = 0; q < found.size(); ++q) {
    const auto by = [&](double Reading::*figure) {
      const std::array values{readings[0][q].*figure, readings[1][q].*figure, readings[2][q].*figure,
                              readings[3][q].*figure};
      return by_differences(event.quantities[q].value, values, around.step,
                            std::hypot(readings[0][q].hidden, readings[1][q].hidden));
    };
    found[q] = by(&Reading::value);
    found[q].error = std::max(found[q].error, std::abs(found[q].value - by(&Reading::coarser).value));
  }
  return found;
}

}  // namespace pfdm
