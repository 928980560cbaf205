#pragma once
// Xu and Needleman's potential of an interface in mixed mode (Modelling Simul. Mater. Sci. Eng. 1 (1993) 111; J. Mech.
// Phys. Solids 42 (1994) 1397), with x = delta_n/length_n, y = |delta_s|/length_s and q the toughness in shear over
// that in opening:
//
//   phi/phi_n = 1 - (1 + x) exp(-x) (1 - q + q exp(-y^2)),   phi_n = e strength length_n,
//                                                            q phi_n = (e/2)^(1/2) shear_strength length_s.
//
// It is the published one with r = 0 (no normal traction at x = 0, whatever the shear), and for q = 1 that with any r.
// Its tractions are secants times separations, T_n = S_n delta_n and T_s = S_s delta_s. The papers' law is reversible;
// here both secants stay those of the largest x and y so far. While both grow this is the published law. Otherwise the
// interface unloads to the origin. It dissipates -dS_n delta_n^2/2 - dS_s |delta_s|^2/2, which is never negative.

namespace pfdm {

struct XuNeedleman {
  double work = 0.0;      ///< phi_n [J/m^2]
  double q = 1.0;         ///< up to 1: beyond, a sheared interface would push its sides apart
  double length_n = 0.0;  ///< [m]
  double length_s = 0.0;  ///< [m]

  /// Law by strengths [Pa] and toughnesses [J/m^2] in opening and in shear.
  static XuNeedleman of(double strength, double toughness, double shear_strength, double shear_toughness);

  double potential(double x, double y) const;      ///< [J/m^2]
  double normal_secant(double x, double y) const;  ///< [Pa/m]
  double shear_secant(double x, double y) const;
  double normal_secant_by_x(double x, double y) const { return -normal_secant(x, y); }
  double normal_secant_by_y(double x, double y) const;
  double shear_secant_by_x(double x, double y) const;
  double shear_secant_by_y(double x, double y) const { return -2.0 * y * shear_secant(x, y); }
  /// Energy that unloading from x and y gives back [J/m^2].
  double stored(double x, double y) const;
};

/// The largest x and y so far, and the separations of a step's two ends over their lengths; openings only.
struct XuNeedlemanStep {
  double x_kept, y_kept;    ///< before the step
  double x_start, y_start;  ///< of its start
  double x, y;              ///< of its end

  double largest_x() const { return x > x_kept ? x : x_kept; }
  double largest_y() const { return y > y_kept ? y : y_kept; }
};

struct XuNeedlemanLoss {
  double energy = 0.0;            ///< dissipated in the step [J/m^2]
  double by_x = 0.0, by_y = 0.0;  ///< its derivatives by the end's x and y [J/m^2]
};

/// Exact where both separations grow from their largest values; where one grows it is exact in that one and of second
/// order in the change of the other.
XuNeedlemanLoss dissipated(const XuNeedleman& law, const XuNeedlemanStep& step);

}  // namespace pfdm
