#pragma once
// Analytic traction-separation laws T(delta) of cohesive interfaces in one mode. Each has a strength sigma_c [Pa] (its
// largest traction), a fracture energy Gc [J/m^2] (its area), and shape parameters:
//
//   softening laws   a straight rise to (delta_0, sigma_c), then sigma_c f((delta - delta_0) sigma_c / Gs) with f of
//                    physics/damage/softening_law.h and Gs = Gc - sigma_c delta_0 / 2; shape: delta_0 sigma_c / (2 Gc)
//   bilinear         the same rise, then two straight lines (Petersson, report TVBM-1006, Lund 1981); shape: the rise's
//                    as above, traction of the kink over sigma_c, share of Gs before the kink
//   xu_needleman     sigma_c (delta/delta_0) exp(1 - delta/delta_0), Gc = e sigma_c delta_0 (Xu, Needleman, J. Mech.
//                    Phys. Solids 42 (1994) 1397)
//   ppr              (Gc/delta_n) (m + a) x (1-x)^(a-1) (m/a + x)^(m-1) (a/m)^m, x = delta/delta_n,
//                    m = a (a-1) L^2 / (1 - a L^2) (Park, Paulino, Roesler, J. Mech. Phys. Solids 57 (2009) 891, mode
//                    I); shape: a, and L = x at the strength over its limit 1/sqrt(a)

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct ShapeParameter {
  std::string_view name;
  double first, lower, upper;  ///< guess and bounds [-]
};

/// A law at one separation.
struct LawPoint {
  double traction = 0.0;  ///< [Pa]
  double slope = 0.0;     ///< its derivative by the separation [Pa/m]
  double work = 0.0;      ///< its integral from 0 [J/m^2]
};

struct TractionSeparationLaw {
  std::string_view name;
  std::string_view description;
  std::vector<ShapeParameter> shape;
  /// [Pa] at the separation [m] (zero for negative ones), strength [Pa], energy [J/m^2] and shape.
  double (*traction)(const TractionSeparationLaw& law, double separation, double strength, double energy,
                     std::span<const double> shape);
  /// Value, slope and work of the law. A negative separation counts as zero, with the slope of the law's beginning.
  LawPoint (*at)(const TractionSeparationLaw& law, double separation, double strength, double energy,
                 std::span<const double> shape);

  /// Whether the law begins with a straight rise, whose share of the energy is its first shape parameter.
  bool has_rise() const { return !shape.empty() && shape.front().name == rise_share; }
  static constexpr std::string_view rise_share = "rise_share_of_energy";
};

std::span<const TractionSeparationLaw> traction_separation_laws();

/// Straight lines between points, with no traction beyond the last one. Its shape is the list of the points
/// x_0, y_0, x_1, y_1 ...: x = separation strength / energy, rising from 0, and y = traction / strength; the area below
/// them is 1.
const TractionSeparationLaw& tabulated_law();

/// Points [m], [Pa] as a tabulated law: its strength, its energy and its shape.
struct TabulatedPoints {
  double strength = 0.0;  ///< largest traction [Pa]
  double energy = 0.0;    ///< area [J/m^2]
  std::vector<double> shape;
};
/// The point (0, 0) is added where the first separation is not zero. Throws InputError unless there are two points at
/// least, the separations rise from zero, no traction is negative, and the law begins with a traction of zero.
TabulatedPoints tabulate(std::span<const double> separation, std::span<const double> traction);

}  // namespace pfdm
