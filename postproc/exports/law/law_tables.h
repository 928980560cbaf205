#pragma once
// A traction-separation curve as tables that other codes interpolate in: T-delta, linear in T, and D-delta, linear in
// D, of T = (1 - D) K delta.

#include <vector>

namespace pfdm {

struct TractionPoint {
  double separation, traction;  ///< [m], [Pa]
};

struct DamagePoint {
  double separation, damage;  ///< [m], of the whole separation; [-]
};

/// The part of the points, the first, the last and the peak among them, between which linear interpolation differs from
/// the others by at most `tolerance` [Pa]. Separations grow.
std::vector<TractionPoint> simplified(const std::vector<TractionPoint>& curve, double tolerance);

/// Of a curve from the origin to zero traction, with K [Pa/m] at least its largest secant: from (separation of the
/// initiation, 0) to (end, 1), never falling. Up to the initiation the curve is within `tolerance` [Pa] of K delta;
/// beyond it so is (1 - D) K delta of the curve.
std::vector<DamagePoint> damage_table(const std::vector<TractionPoint>& curve, double stiffness, double tolerance);

/// Linear between the points [Pa]; zero beyond the last.
double traction_at(const std::vector<TractionPoint>& curve, double separation);
/// (1 - D) K delta, D linear between the points [Pa].
double traction_at(const std::vector<DamagePoint>& table, double stiffness, double separation);

/// int T ddelta [J/m^2].
double area_under(const std::vector<TractionPoint>& curve);
/// Likewise of (1 - D) K delta, exactly.
double area_under(const std::vector<DamagePoint>& table, double stiffness);

}  // namespace pfdm
