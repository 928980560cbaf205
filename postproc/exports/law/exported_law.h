#pragma once
// One law of a run's record as other codes take it: a bilinear set (penalty stiffness, strengths, energies, exponent of
// the mode mix) and the tables T-delta and D-delta.
//
// The extracted separation is without elastic part, so the penalty stiffness K is put in series: delta + T/K for delta.
// This changes no energy, as int T dT/K vanishes over a law that ends without traction. The rule for K makes the rise
// of the bilinear law a hundredth of its final separation, K = 50 strength^2 / GI, in series with the straight part of
// the law's own rise.

#include "postproc/cohesive/cohesive_results.h"
#include "postproc/exports/law/law_tables.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// What its user decides; the rest follows from the record.
struct ExportChoice {
  std::optional<std::string> surface{};    ///< none: the surface with the best known law
  std::optional<double> angle{};           ///< polar angle [rad]; none: the best known law of least mode mixity
  std::optional<double> stiffness{};       ///< [Pa/m]
  std::optional<double> energy{};          ///< mode I [J/m^2], of a law that is not known to its end
  std::optional<double> shear_strength{};  ///< [Pa]
  std::optional<double> shear_energy{};    ///< mode II [J/m^2]
  std::optional<double> exponent{};        ///< of Benzeggagh and Kenane [-]
};

struct Figure {
  double value = 0.0;
  std::string basis{};  ///< what it rests on
};

/// How a law mixes its modes. b: shear strength over strength; B: the shear's share of the work.
enum class ModeMix {
  one_energy,         ///< Camacho and Ortiz': GII = GI, stiffness in shear b^2 K, T_n^2 + (T_s/b)^2 = strength^2
  benzeggagh_kenane,  ///< GI + (GII - GI) B^exponent, strength^2 likewise
  power_law           ///< ((1-B)/GI)^exponent + (B/GII)^exponent = Gc^-exponent, (T_n/s_n)^2 + (T_s/s_s)^2 = 1
};

struct ExportedLaw {
  std::string surface;     ///< plain name
  Figure stiffness;        ///< K, normal [Pa/m]
  Figure shear_stiffness;  ///< [Pa/m]
  Figure strength;         ///< normal [Pa]
  Figure shear_strength;   ///< [Pa]
  Figure energy;           ///< GI: whole area of the law [J/m^2]
  Figure shear_energy;     ///< GII [J/m^2]
  Figure exponent;         ///< [-]
  ModeMix mix = ModeMix::one_energy;
  std::string rule = "camacho_ortiz";  ///< of pfdm, which the mix stands for
  double initiation = 0.0;             ///< traction at which the law leaves K delta: where D begins [Pa]
  std::vector<TractionPoint> curve{};  ///< from (0, 0) to (final separation, 0)
  std::vector<DamagePoint> damage{};   ///< from the initiation to 1
  std::string origin = "record";       ///< what the law is of, in the head of the file
  double curve_error = 0.0;            ///< of T-delta at the states of the origin, over the strength
  double damage_error = 0.0;           ///< of D-delta likewise, everywhere: at most
  std::vector<std::string> remarks{};  ///< source, frame, what was seen; SI

  /// Shear strength over strength.
  double shear_ratio() const { return shear_strength.value / strength.value; }
  /// Whether all modes have one stiffness, so that an opened interface pulls along its separation.
  bool has_one_stiffness() const;
  double onset() const { return strength.value / stiffness.value; }                ///< of the bilinear law [m]
  double final_separation() const { return 2.0 * energy.value / strength.value; }  ///< likewise
};

/// Tables follow the record's states within this share of the strength, each step of the two that make them.
constexpr double table_tolerance = 1e-3;

/// As the rules are called in the heads of the files: "Benzeggagh and Kenane's rule".
std::string_view name_of(ModeMix mix);

/// Throws InputError where no law was recorded, none is chosen, or the chosen values make none: a stiffness with which
/// the rise alone takes more than the energy, a law that is not known to its end without an energy.
ExportedLaw law_to_export(const CohesiveReport& report, const ExportChoice& choice);

}  // namespace pfdm
