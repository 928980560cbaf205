#include "physics/interfaces/xu_needleman.h"

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

double squared(double x) { return x * x; }

// The integral of s^2 exp(-s) ds from `from` to `to`.
double opening_moment(double from, double to) {
  const auto rest = [](double s) { return (s * s + 2.0 * s + 2.0) * std::exp(-s); };
  return rest(from) - rest(to);
}

// The integral of 2 s^3 exp(-s^2) ds.
double shear_moment(double from, double to) {
  const auto rest = [](double s) { return (s * s + 1.0) * std::exp(-s * s); };
  return rest(from) - rest(to);
}

XuNeedlemanLoss by_both(const XuNeedleman& law, const XuNeedlemanStep& s) {
  const auto lost = [&](double x, double y) { return law.potential(x, y) - law.stored(x, y); };
  const double n2 = squared(s.x * law.length_n), s2 = squared(s.y * law.length_s);
  return {.energy = lost(s.x, s.y) - lost(s.x_kept, s.y_kept),
          .by_x = -0.5 * (law.normal_secant_by_x(s.x, s.y) * n2 + law.shear_secant_by_x(s.x, s.y) * s2),
          .by_y = -0.5 * (law.normal_secant_by_y(s.x, s.y) * n2 + law.shear_secant_by_y(s.x, s.y) * s2)};
}

// The other separation, below its largest, counts by the mean of its squares.
XuNeedlemanLoss by_opening(const XuNeedleman& law, const XuNeedlemanStep& s) {
  const double y = s.y_kept, part = 1.0 - law.q + law.q * std::exp(-y * y);
  const double s2 = 0.5 * squared(law.length_s) * (squared(s.y_start) + squared(s.y));
  const double fall = law.shear_secant(s.x_kept, y) - law.shear_secant(s.x, y);
  return {.energy = 0.5 * law.work * part * opening_moment(s.x_kept, s.x) + 0.5 * s2 * fall,
          .by_x = -0.5 *
                  (law.normal_secant_by_x(s.x, y) * squared(s.x * law.length_n) + law.shear_secant_by_x(s.x, y) * s2),
          .by_y = 0.5 * squared(law.length_s) * s.y * fall};
}

XuNeedlemanLoss by_shear(const XuNeedleman& law, const XuNeedlemanStep& s) {
  const double x = s.x_kept, part = law.q * (1.0 + x) * std::exp(-x);
  const double n2 = 0.5 * squared(law.length_n) * (squared(s.x_start) + squared(s.x));
  const double fall = law.normal_secant(x, s.y_kept) - law.normal_secant(x, s.y);
  return {.energy = law.work * part * shear_moment(s.y_kept, s.y) + 0.5 * n2 * fall,
          .by_x = 0.5 * squared(law.length_n) * s.x * fall,
          .by_y = -0.5 *
                  (law.shear_secant_by_y(x, s.y) * squared(s.y * law.length_s) + law.normal_secant_by_y(x, s.y) * n2)};
}

}  // namespace

XuNeedleman XuNeedleman::of(double strength, double toughness, double shear_strength, double shear_toughness) {
  return {.work = toughness,
          .q = shear_toughness / toughness,
          .length_n = toughness / (std::numbers::e * strength),
          .length_s = shear_toughness / (std::sqrt(0.5 * std::numbers::e) * shear_strength)};
}

double XuNeedleman::potential(double x, double y) const {
  return work * (1.0 - (1.0 + x) * std::exp(-x) * (1.0 - q + q * std::exp(-y * y)));
}

double XuNeedleman::normal_secant(double x, double y) const {
  return work / squared(length_n) * std::exp(-x) * (1.0 - q + q * std::exp(-y * y));
}

double XuNeedleman::shear_secant(double x, double y) const {
  return 2.0 * q * work / squared(length_s) * (1.0 + x) * std::exp(-x - y * y);
}

double XuNeedleman::normal_secant_by_y(double x, double y) const {
  return -2.0 * y * q * work / squared(length_n) * std::exp(-x - y * y);
}

double XuNeedleman::shear_secant_by_x(double x, double y) const {
  return -2.0 * q * work / squared(length_s) * x * std::exp(-x - y * y);
}

double XuNeedleman::stored(double x, double y) const {
  return 0.5 * (normal_secant(x, y) * squared(x * length_n) + shear_secant(x, y) * squared(y * length_s));
}

XuNeedlemanLoss dissipated(const XuNeedleman& law, const XuNeedlemanStep& step) {
  const bool opens = step.x > step.x_kept, slides = step.y > step.y_kept;
  if (opens && slides) return by_both(law, step);
  if (opens) return by_opening(law, step);
  return slides ? by_shear(law, step) : XuNeedlemanLoss{};
}

}  // namespace pfdm
