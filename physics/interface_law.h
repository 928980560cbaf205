#pragma once
// Cohesive interfaces in mixed mode: a traction-separation law in one mode (physics/traction_separation.h), of an
// equivalent separation,
//
//   lambda^2 = <delta_n>^2 + rho |delta_s|^2,   B = rho |delta_s|^2 / lambda^2,   T = S (<delta_n> n + rho delta_s),
//
// with the secant S = T_1(lambda)/lambda of the law at the strength and toughness of the mode mixity B:
//
//   camacho_ortiz       rho = beta^2, strength and toughness do not depend on B: the strength in shear is beta times
//                       that in opening, the toughness the same (Camacho, Ortiz, Int. J. Solids Struct. 33 (1996) 2899)
//   benzeggagh_kenane   rho = 1, Gc = G_n + (G_s - G_n) B^eta, strength^2 likewise (Benzeggagh, Kenane, Compos. Sci.
//                       Technol. 56 (1996) 439; Turon, Camanho, Costa, Davila, Mech. Mater. 38 (2006) 1072)
//   power_law           rho = 1, ((1-B)/G_n)^eta + (B/G_s)^eta = Gc^-eta, and (1-B)/s_n^2 + B/s_s^2 = 1/strength^2
//
// Irreversible: S never grows, so that unloading goes to the origin. The first rule remembers the largest lambda, the
// others, whose law changes with B, the damage D = 1 - S/K; they need a law with a straight rise, of stiffness K.
// In compression the initial stiffness resists again, whatever has broken. With friction the broken part D of a closed
// interface carries D tau, tau = rho K (delta_s - slip), |tau| <= mu |T_n| (Alfano, Sacco, Int. J. Numer. Meth. Engng
// 68 (2006) 542).

#include "physics/tensor.h"
#include "physics/traction_separation.h"

#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

/// Of one place of an interface.
struct InterfaceStrength {
  double strength = 0.0;         ///< in opening [Pa]
  double toughness = 0.0;        ///< likewise [J/m^2]
  double shear_strength = 0.0;   ///< of rules whose law depends on the mode [Pa]
  double shear_toughness = 0.0;  ///< likewise [J/m^2]
  double stiffness = 0.0;        ///< of the straight rise [Pa/m]; of laws that have one
};

/// A law's strength and toughness at one mode mixity, and their derivatives by it.
struct ModeMixture {
  double strength, toughness;  // [Pa], [J/m^2]
  double strength_by_B = 0.0, toughness_by_B = 0.0;
};

struct MixedMode {
  std::string_view name;
  std::string_view description;
  /// At the mode mixity B; null: that of opening at any. `exponent`, eta, is at least 1.
  ModeMixture (*at)(const InterfaceStrength& strength, double B, double exponent);
};
std::span<const MixedMode> mixed_modes();

struct InterfaceHistory {
  double reached = 0.0;          ///< largest lambda [m], or the damage D where the law depends on the mode
  double dissipated = 0.0;       ///< by decohesion [J/m^2]
  double rubbed = 0.0;           ///< by friction [J/m^2]
  Vector slip = Vector::Zero();  ///< of the friction [m]
  friend bool operator==(const InterfaceHistory&, const InterfaceHistory&) = default;
};

struct InterfaceResponse {
  Vector traction;  ///< on the side that the normal leaves, [Pa]
  Tensor tangent;   ///< its derivative by the separation [Pa/m]
  Tensor secant;    ///< symmetric, positive semi-definite, nearly traction / separation [Pa/m]
  InterfaceHistory history{};
  double stored = 0.0;                        ///< [J/m^2]
  Vector dissipation_slope = Vector::Zero();  ///< of what decohesion dissipates, by the separation [Pa]
};

struct InterfaceLaw {
  const TractionSeparationLaw* law = nullptr;
  std::vector<double> shape{};  ///< of the law, less the share of a straight rise
  const MixedMode* mixed_mode = nullptr;
  double shear_ratio = 1.0;  ///< beta; 1 for rules whose law depends on the mode
  double exponent = 1.0;     ///< eta of these
  double friction = 0.0;     ///< mu

  /// At the separation [m], of the side that the unit normal n enters from the other one, after `before`.
  InterfaceResponse respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                            const InterfaceHistory& before) const;
  /// Stiffness of the unbroken interface in opening [Pa/m].
  double initial_stiffness(const InterfaceStrength& at) const;
  /// Steepest fall of the traction in opening [Pa/m], positive.
  double steepest_fall(const InterfaceStrength& at) const;
  /// Fraction of the toughness that has been dissipated by decohesion, 0 to 1; where that depends on the mode: over
  /// what has been and what is still to be in the mode of this separation [m].
  double damage(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                const InterfaceHistory& history) const;
  bool depends_on_mode() const { return mixed_mode->at != nullptr; }

 private:
  struct Opening;
  LawPoint point(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const;
  double secant_by_mode(const InterfaceStrength& at, const ModeMixture& mixture, const LawPoint& p,
                        double lambda) const;
  double dissipated(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const;
  double left_to_dissipate(const InterfaceStrength& at, double B, const InterfaceHistory& history) const;
  double separation_at_secant(const InterfaceStrength& at, const ModeMixture& mixture, double secant,
                              double above) const;
  void pull(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& before,
            InterfaceResponse& response, Vector& secant_by_separation) const;
  void rub(double K, const Opening& opening, const InterfaceHistory& before, double secant_before,
           const Vector& secant_by_separation, InterfaceResponse& response) const;
  double secant_after(const InterfaceStrength& at, const InterfaceHistory& history) const;
};

}  // namespace pfdm
