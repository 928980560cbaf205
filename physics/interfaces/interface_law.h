#pragma once
// Cohesive interfaces in mixed mode: a traction-separation law in one mode (physics/interfaces/traction_separation.h),
// of an equivalent separation,
//
//   lambda^2 = <delta_n>^2 + rho |delta_s|^2,   B = rho |delta_s|^2 / lambda^2,   T = S (<delta_n> n + k delta_s),
//
// with the secant S = T_1(lambda)/lambda of the law at the strength and toughness of the mode mixity B:
//
//   camacho_ortiz       rho = k = beta^2, strength and toughness do not depend on B: the strength in shear is beta
//                       times that in opening, the toughness the same (Camacho, Ortiz, Int. J. Solids Struct. 33
//                       (1996) 2899)
//   equal_stiffness     rho = 1/beta^2, k = 1: the strength in shear is beta times that in opening, the toughness
//                       beta^2 times, the stiffness the same. With the law of Smith and Ferrante (xu_needleman) this is
//                       T = S (delta_n n + delta_s), lambda^2 = delta_n^2 + b^2 delta_s^2, b = 1/beta
//   benzeggagh_kenane   rho = k = 1, Gc = G_n + (G_s - G_n) B^eta, strength^2 likewise (Benzeggagh, Kenane, Compos.
//                       Sci. Technol. 56 (1996) 439; Turon, Camanho, Costa, Davila, Mech. Mater. 38 (2006) 1072)
//   power_law           rho = k = 1, ((1-B)/G_n)^eta + (B/G_s)^eta = Gc^-eta, (1-B)/s_n^2 + B/s_s^2 = 1/strength^2
//
// or, as the rule xu_needleman, of their potential, with two secants (physics/interfaces/xu_needleman.h).
//
// Irreversible: S never grows, so that unloading goes to the origin. The first two rules remember the largest lambda;
// those whose law changes with B remember the damage D = 1 - S/K, and need a law with a straight rise, of stiffness K.
// In compression the initial stiffness resists again, whatever has broken. With friction the broken part D of a closed
// interface carries D tau, tau = k K (delta_s - slip), |tau| <= mu |T_n| (Alfano, Sacco, Int. J. Numer. Meth. Engng
// 68 (2006) 542).
//
// What a step dissipates, -dS delta.delta/2, is integrated over its secants: exactly in one mode and for camacho_ortiz,
// else by the mean over the modes of its two ends; so is the work of friction. Both are of second order in the step.
//
// With a rate (interface_rate.h) T is (1 + r) times that, r of the step's own rate (lambda - lambda_before)/duration:
// implicit, of first order. Contact and friction do not know it. What the law without rate takes up in a step times the
// mean of r at its two ends is viscous: in balance with the work of the tractions to the second order. Maxwell branches
// (interface_branches.h) pull beside all that.

#include "physics/interfaces/interface_branches.h"
#include "physics/interfaces/interface_rate.h"
#include "physics/interfaces/traction_separation.h"
#include "physics/tensor.h"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

/// Strength and stiffness at one place of an interface.
struct InterfaceStrength {
  double strength = 0.0;         ///< in opening [Pa]
  double toughness = 0.0;        ///< in opening [J/m^2]
  double shear_strength = 0.0;   ///< of rules whose law depends on the mode [Pa]
  double shear_toughness = 0.0;  ///< of rules whose law depends on the mode [J/m^2]
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
  /// Strength and toughness at the mode mixity B; null: those of opening at any B. `exponent`, eta, is at least 1.
  ModeMixture (*at)(const InterfaceStrength& strength, double B, double exponent);
  bool keeps_stiffness = false;  ///< whether shear_ratio leaves the stiffness as it is, k = 1
  bool is_potential = false;     ///< the potential of Xu and Needleman

  /// Whether it mixes the modes of this law.
  bool suits(const TractionSeparationLaw& law) const;
  /// Whether it needs shear_strength and shear_toughness, else shear_ratio.
  bool has_shear_strength() const { return at != nullptr || is_potential; }
};
std::span<const MixedMode> mixed_modes();

struct InterfaceHistory {
  /// Largest lambda [m]; the damage D where the law depends on the mode; the largest x of the potential.
  double reached = 0.0;
  double reached_in_shear = 0.0;                ///< largest y of the potential
  double dissipated = 0.0;                      ///< by decohesion [J/m^2]
  double rubbed = 0.0;                          ///< by friction [J/m^2]
  double viscous = 0.0;                         ///< by the rate of opening, and by branches [J/m^2]
  double overstress = 0.0;                      ///< r of the last step [-]
  BranchTractions branch = relaxed_branches();  ///< q of the branches [Pa]; or numbers of one's own law
  Vector slip = Vector::Zero();                 ///< of the friction [m]
  double opening = 0.0;                         ///< delta_n now [m]
  Vector shear = Vector::Zero();                ///< delta_s now [m]
  friend bool operator==(const InterfaceHistory&, const InterfaceHistory&) = default;
};

struct InterfaceResponse {
  Vector traction;  ///< on the side that the normal leaves, [Pa]
  Tensor tangent;   ///< its derivative by the separation [Pa/m]
  Tensor secant;    ///< symmetric, positive semi-definite, nearly traction / separation [Pa/m]
  InterfaceHistory history{};
  double stored = 0.0;                        ///< [J/m^2]
  Vector dissipation_slope = Vector::Zero();  ///< of what decohesion dissipates, by the separation [Pa]
  Vector by_overstress = Vector::Zero();      ///< derivative of the traction by r [Pa]
  Vector overstress_slope = Vector::Zero();  ///< of r by the separation [1/m]: by_overstress times it is in the tangent
};

/// A law of one's own in place of those above; at finite strain one that pulls along the separation of an opened face.
/// A step that takes no time to the separation of the history gives the traction again.
class OwnInterfaceLaw {
 public:
  OwnInterfaceLaw() = default;
  OwnInterfaceLaw(const OwnInterfaceLaw&) = delete;
  OwnInterfaceLaw& operator=(const OwnInterfaceLaw&) = delete;
  virtual ~OwnInterfaceLaw() = default;

  virtual bool depends_on_rate() const { return false; }
  /// As InterfaceLaw::respond(), compression included. Its history is `branch`, with zeros at first, and `dissipated`.
  virtual InterfaceResponse respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                                    const InterfaceHistory& before, double duration) const = 0;
};

struct InterfaceLaw {
  const TractionSeparationLaw* law = nullptr;
  std::vector<double> shape{};  ///< of the law, less the share of a straight rise
  const MixedMode* mixed_mode = nullptr;
  double shear_ratio = 1.0;  ///< beta; 1 for rules with a shear strength
  double exponent = 1.0;     ///< eta of these
  double friction = 0.0;     ///< mu
  InterfaceRate rate{};
  std::vector<InterfaceBranch> branches{};           ///< up to most_interface_branches
  std::shared_ptr<const OwnInterfaceLaw> own_law{};  ///< takes the place of all above, of contact as well

  /// Response at the separation [m] of the side that the unit normal n enters from the other one, after `before` and a
  /// step of this duration [s]. 0: no time passes, r and q stay what they were. `overstress`: r where it is known
  /// better than from the separation, which hardly tells it of a face at rest (solver/fracture/equilibrium).
  InterfaceResponse respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                            const InterfaceHistory& before, double duration = 0.0,
                            std::optional<double> overstress = {}) const;
  /// By how much lambda exceeds that of `before` at this separation [m].
  double growth(const Vector& n, const Vector& separation, const InterfaceHistory& before) const;
  /// Stiffness of the unbroken interface in opening [Pa/m].
  double initial_stiffness(const InterfaceStrength& at) const;
  /// Stiffness of the unbroken interface in shear [Pa/m].
  double initial_shear_stiffness(const InterfaceStrength& at) const;
  /// Steepest fall of the traction in opening [Pa/m], positive.
  double steepest_fall(const InterfaceStrength& at) const;
  /// Fraction of the toughness that has been dissipated by decohesion, 0 to 1: over what has been and what is still to
  /// be in the mode of this separation [m]. Of one's own law over the toughness in opening.
  double damage(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                const InterfaceHistory& history) const;
  /// Whether a straight rise of this stiffness, in opening or in shear, takes all the toughness or more.
  bool is_all_rise(const InterfaceStrength& at) const;
  bool depends_on_mode() const { return mixed_mode->at != nullptr; }
  /// Whether steps have to have a duration.
  bool depends_on_rate() const { return own_law ? own_law->depends_on_rate() : rate.any() || !branches.empty(); }
  /// Whether an opened interface pulls along its separation, in any mode.
  bool pulls_along_separation() const;

 private:
  struct Opening;
  struct Pull;
  struct Loss;
  LawPoint point(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const;
  ModeMixture mixture(const InterfaceStrength& at, double B) const;
  double secant_by_mode(const InterfaceStrength& at, const ModeMixture& mixture, const LawPoint& p,
                        double lambda) const;
  double work_by_mode(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const;
  double dissipated(const InterfaceStrength& at, const ModeMixture& mixture, double lambda) const;
  double left_to_dissipate(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& history) const;
  double left_in_potential(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& history) const;
  double separation_at_secant(const InterfaceStrength& at, const ModeMixture& mixture, double secant) const;
  Pull pull(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& before,
            InterfaceResponse& response) const;
  Pull pull_by_potential(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& before,
                         InterfaceResponse& response) const;
  Loss lost(const InterfaceStrength& at, const Opening& from, const Opening& to, double reached, const LawPoint& p,
            const Vector& secant_slope) const;
  Loss lost_by_mode(const InterfaceStrength& at, const Opening& from, const Opening& to, double kept, const LawPoint& p,
                    const Vector& secant_slope) const;
  void resist(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& before, double duration,
              std::optional<double> overstress, InterfaceResponse& response) const;
  void relax(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& before, const Pull& own,
             double duration, InterfaceResponse& response) const;
  void rub(const InterfaceStrength& at, const Opening& opening, const InterfaceHistory& before, const Pull& own,
           InterfaceResponse& response) const;
  double secant_after(const InterfaceStrength& at, const InterfaceHistory& history) const;
  double shear_secant_after(const InterfaceStrength& at, const InterfaceHistory& history) const;
  double stored_after(const InterfaceStrength& at, const InterfaceHistory& history) const;
};

}  // namespace pfdm
