// Abaqus. Layout and meaning: keyword reference, *DAMAGE INITIATION, *DAMAGE EVOLUTION (TYPE=ENERGY, MIXED MODE
// BEHAVIOR=BK or POWER LAW; TYPE=DISPLACEMENT, SOFTENING=LINEAR or TABULAR, MIXED MODE BEHAVIOR=TABULAR), *COHESIVE
// SECTION, *COHESIVE BEHAVIOR, as on abaqus-docs.mit.edu/2017/English/SIMACAEKEYRefMap/simakey-r-damageevolution.htm;
// analysis guide, "Defining the constitutive response of cohesive elements using a traction-separation description":
//
//   T_i = (1 - D) K_i delta_i,   delta_m^2 = <delta_n>^2 + delta_s^2,   QUADS: sum (K_i delta_i / strength_i)^2 = 1,
//   linear softening: D = delta_f (delta_m - delta_0) / (delta_m (delta_f - delta_0)),   delta_f = 2 Gc/|T at delta_0|,
//
// or delta_f - delta_0, or D of delta_m - delta_0, as a table of the mode mix. MODE MIX RATIO=ENERGY: the work of the
// shear over the whole, T_s delta_s / (T . delta), of the current state. The energy is the whole area of the law.
//
// Where the stiffnesses differ T is not along delta, and an energy would be spent to a part only in mixed mode: Camacho
// and Ortiz' rule is written by displacements. Its lambda is delta_m times a factor of the mode mix alone.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/law/mode_remarks.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

constexpr int mode_mixes = 17;  // of the tables

std::string three(double normal, double shear) {
  return fmt::format("{}, {}, {}\n", deck_number(normal), deck_number(shear), deck_number(shear));
}

std::string initiation(const ExportedLaw& law, double share) {
  return "*DAMAGE INITIATION, CRITERION=QUADS\n" + three(share * law.strength.value, share * law.shear_strength.value);
}

bool is_by_displacement(const ExportedLaw& law) { return law.mix == ModeMix::one_energy && !law.has_one_stiffness(); }

struct MixedSeparation {
  double mix;     ///< the shear's part of the work
  double factor;  ///< delta_m over Camacho and Ortiz' lambda, (1 - mix + mix/b^2)^(1/2)
};

/// From opening to shear, evenly in the factor.
std::vector<MixedSeparation> mixed_separations(double b) {
  std::vector<MixedSeparation> mixed;
  const double in_shear = 1.0 / b;
  for (int i = 0; i < mode_mixes; ++i) {
    const double factor = 1.0 + (in_shear - 1.0) * i / (mode_mixes - 1);
    mixed.push_back({(factor * factor - 1.0) / (in_shear * in_shear - 1.0), factor});
  }
  return mixed;
}

std::string bilinear_by_displacement(const ExportedLaw& law) {
  std::string text =
      "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT, SOFTENING=LINEAR, MIXED MODE BEHAVIOR=TABULAR, MODE MIX RATIO=ENERGY\n";
  for (const auto [mix, factor] : mixed_separations(law.shear_ratio()))
    text += fmt::format("{}, {}\n", deck_number(factor * (law.final_separation() - law.onset())), deck_number(mix));
  return text;
}

std::string bilinear(const ExportedLaw& law) {
  if (is_by_displacement(law)) return initiation(law, 1.0) + bilinear_by_displacement(law);
  return initiation(law, 1.0) +
         fmt::format("*DAMAGE EVOLUTION, TYPE=ENERGY, SOFTENING=LINEAR, MIXED MODE BEHAVIOR={}, POWER={}\n",
                     law.mix == ModeMix::power_law ? "POWER LAW" : "BK", deck_number(law.exponent.value)) +
         three(law.energy.value, law.shear_energy.value);
}

std::string tabular(const ExportedLaw& law) {
  const bool mixed = is_by_displacement(law);
  std::string text = initiation(law, law.initiation / law.strength.value) +
                     "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT, SOFTENING=TABULAR" +
                     (mixed ? ", MIXED MODE BEHAVIOR=TABULAR, MODE MIX RATIO=ENERGY\n" : "\n");
  const double begin = law.damage.front().separation;
  for (const auto [mix, factor] : mixed ? mixed_separations(law.shear_ratio()) : std::vector<MixedSeparation>{{0, 1}})
    for (const DamagePoint& p : law.damage)
      text += fmt::format("{}, {}{}\n", deck_number(p.damage), deck_number(factor * (p.separation - begin)),
                          mixed ? ", " + deck_number(mix) : "");
  return text;
}

std::string elastic(const ExportedLaw& law) {
  return "*ELASTIC, TYPE=TRACTION\n" + three(law.stiffness.value, law.shear_stiffness.value);
}

std::string abaqus_table_remark(const ExportedLaw& law) {
  if (is_by_displacement(law))
    return "Cohesive surfaces of Abaqus/Explicit take MODE MIX RATIO=ACCUMULATED ENERGY in place of ENERGY.";
  if (law.mix == ModeMix::one_energy) return "";
  return "Of the table: it is the law in opening, no mode mix; D acts on the separation's magnitude.";
}

}  // namespace

std::string abaqus_input(const ExportedLaw& law, const UnitSystem&) {
  const std::string name = "PFDM_" + law.surface;
  std::string text = comment_lines("Cohesive elements: name one of the materials in your section,", "**");
  text += fmt::format(
      "**   *COHESIVE SECTION, ELSET=..., MATERIAL={}, RESPONSE=TRACTION SEPARATION, "
      "THICKNESS=SPECIFIED\n**   1.0\n",
      name);
  text += comment_lines(
      "with that thickness, so that strains are separations. Cohesive surfaces: name the interaction in your *CONTACT "
      "PAIR. " +
          quadratic_strength_remark(law) + " " + abaqus_table_remark(law),
      "**");
  text += fmt::format("*MATERIAL, NAME={}\n", name) + elastic(law) + bilinear(law);
  text += fmt::format("*MATERIAL, NAME={}_TABLE\n", name) + elastic(law) + tabular(law);
  text += fmt::format("*SURFACE INTERACTION, NAME={}_CONTACT\n*COHESIVE BEHAVIOR\n", name) +
          three(law.stiffness.value, law.shear_stiffness.value) + bilinear(law);
  return text;
}

}  // namespace pfdm
