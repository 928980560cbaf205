#include "postproc/exports/law/law_tables.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr int deepest = 40;  // halvings of an interval

double between(double x, double x0, double y0, double x1, double y1) {
  return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
}

/// Douglas and Peucker's, by the difference of the tractions.
void keep_between(const std::vector<TractionPoint>& curve, std::size_t a, std::size_t b, double tolerance,
                  std::vector<bool>& kept) {
  std::size_t farthest = a;
  double largest = tolerance;
  for (std::size_t i = a + 1; i < b; ++i) {
    const double line =
        between(curve[i].separation, curve[a].separation, curve[a].traction, curve[b].separation, curve[b].traction);
    if (std::abs(line - curve[i].traction) <= largest) continue;
    largest = std::abs(line - curve[i].traction);
    farthest = i;
  }
  if (farthest == a) return;
  kept[farthest] = true;
  keep_between(curve, a, farthest, tolerance, kept);
  keep_between(curve, farthest, b, tolerance, kept);
}

double damage_of(const TractionPoint& p, double stiffness) {
  return std::clamp(1.0 - p.traction / (stiffness * p.separation), 0.0, 1.0);
}

/// Appends what lies between two points of a line, and the second. Linear in D is not linear in T: where the separation
/// grows by a factor, T would rise far above the line.
void refine(const TractionPoint& a, const TractionPoint& b, double stiffness, double tolerance, int depth,
            std::vector<DamagePoint>& table) {
  const double mid = std::sqrt(a.separation * b.separation);
  const TractionPoint m{mid, between(mid, a.separation, a.traction, b.separation, b.traction)};
  const double D = between(mid, a.separation, damage_of(a, stiffness), b.separation, damage_of(b, stiffness));
  if (depth < deepest && std::abs((1.0 - D) * stiffness * mid - m.traction) > tolerance) {
    refine(a, m, stiffness, tolerance, depth + 1, table);
    refine(m, b, stiffness, tolerance, depth + 1, table);
    return;
  }
  table.push_back({b.separation, std::max(table.back().damage, damage_of(b, stiffness))});
}

}  // namespace

std::vector<TractionPoint> simplified(const std::vector<TractionPoint>& curve, double tolerance) {
  std::vector<bool> kept(curve.size(), false);
  const auto peak =
      static_cast<std::size_t>(std::ranges::max_element(curve, {}, &TractionPoint::traction) - curve.begin());
  kept.front() = kept.back() = kept[peak] = true;
  keep_between(curve, 0, peak, tolerance, kept);
  keep_between(curve, peak, curve.size() - 1, tolerance, kept);
  std::vector<TractionPoint> points;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (kept[i]) points.push_back(curve[i]);
  return points;
}

std::vector<DamagePoint> damage_table(const std::vector<TractionPoint>& curve, double stiffness, double tolerance) {
  std::size_t first = 1;  // the last point on the straight rise
  while (first + 1 < curve.size() && stiffness * curve[first + 1].separation - curve[first + 1].traction <= tolerance)
    ++first;
  const TractionPoint initiation{curve[first].traction / stiffness, curve[first].traction};
  std::vector<DamagePoint> table{{initiation.separation, 0.0}};
  if (initiation.separation < curve[first].separation * (1.0 - 1e-9))
    table.push_back({curve[first].separation, damage_of(curve[first], stiffness)});
  for (std::size_t i = first; i + 1 < curve.size(); ++i) refine(curve[i], curve[i + 1], stiffness, tolerance, 0, table);
  return table;
}

double traction_at(const std::vector<TractionPoint>& curve, double separation) {
  const auto next = std::ranges::upper_bound(curve, separation, {}, &TractionPoint::separation);
  if (next == curve.begin() || next == curve.end()) return 0.0;
  const TractionPoint &a = *(next - 1), &b = *next;
  return between(separation, a.separation, a.traction, b.separation, b.traction);
}

double traction_at(const std::vector<DamagePoint>& table, double stiffness, double separation) {
  const auto next = std::ranges::upper_bound(table, separation, {}, &DamagePoint::separation);
  if (next == table.begin()) return stiffness * separation;
  if (next == table.end()) return 0.0;
  const DamagePoint &a = *(next - 1), &b = *next;
  return (1.0 - between(separation, a.separation, a.damage, b.separation, b.damage)) * stiffness * separation;
}

double area_under(const std::vector<TractionPoint>& curve) {
  double area = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i)
    area += 0.5 * (curve[i].traction + curve[i - 1].traction) * (curve[i].separation - curve[i - 1].separation);
  return area;
}

double area_under(const std::vector<DamagePoint>& table, double stiffness) {
  double area = 0.5 * stiffness * table.front().separation * table.front().separation;
  for (std::size_t i = 1; i < table.size(); ++i) {  // quadratic in between: Simpson's rule is exact
    const DamagePoint &a = table[i - 1], &b = table[i];
    const double mid = 0.5 * (a.separation + b.separation);
    area += (b.separation - a.separation) / 6.0 *
            ((1.0 - a.damage) * stiffness * a.separation + 4.0 * (1.0 - 0.5 * (a.damage + b.damage)) * stiffness * mid +
             (1.0 - b.damage) * stiffness * b.separation);
  }
  return area;
}

}  // namespace pfdm
