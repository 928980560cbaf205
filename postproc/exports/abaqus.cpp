// Abaqus. Layout and meaning: keyword reference, *DAMAGE INITIATION, *DAMAGE EVOLUTION (TYPE=ENERGY, MIXED MODE
// BEHAVIOR=BK; TYPE=DISPLACEMENT, SOFTENING=TABULAR), *COHESIVE SECTION, *COHESIVE BEHAVIOR, as on
// abaqus-docs.mit.edu/2017/English/SIMACAEKEYRefMap/simakey-r-damageevolution.htm; analysis guide, "Defining the
// constitutive response of cohesive elements using a traction-separation description". The energy is the whole area of
// the law, and the displacement of a table is counted from the initiation of damage.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/export_head.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

std::string three(double normal, double shear) {
  return fmt::format("{}, {}, {}\n", deck_number(normal), deck_number(shear), deck_number(shear));
}

std::string initiation(const ExportedLaw& law, double share) {
  return "*DAMAGE INITIATION, CRITERION=QUADS\n" + three(share * law.strength.value, share * law.shear_strength.value);
}

std::string bilinear(const ExportedLaw& law) {
  return initiation(law, 1.0) +
         fmt::format("*DAMAGE EVOLUTION, TYPE=ENERGY, SOFTENING=LINEAR, MIXED MODE BEHAVIOR=BK, POWER={}\n",
                     deck_number(law.exponent.value)) +
         three(law.energy.value, law.shear_energy.value);
}

std::string tabular(const ExportedLaw& law) {
  std::string text = initiation(law, law.initiation / law.strength.value) +
                     "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT, SOFTENING=TABULAR\n";
  for (const DamagePoint& p : law.damage)
    text += fmt::format("{}, {}\n", deck_number(p.damage), deck_number(p.separation - law.damage.front().separation));
  return text;
}

std::string elastic(const ExportedLaw& law) {
  return "*ELASTIC, TYPE=TRACTION\n" + three(law.stiffness.value, law.stiffness.value);
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
      "with that thickness, so that strains are separations. Cohesive surfaces: name the interaction in "
      "your *CONTACT PAIR. Of the table: no mode mix; D acts on the separation's magnitude.",
      "**");
  text += fmt::format("*MATERIAL, NAME={}\n", name) + elastic(law) + bilinear(law);
  text += fmt::format("*MATERIAL, NAME={}_TABLE\n", name) + elastic(law) + tabular(law);
  text += fmt::format("*SURFACE INTERACTION, NAME={}_CONTACT\n*COHESIVE BEHAVIOR\n", name) +
          three(law.stiffness.value, law.stiffness.value) + bilinear(law);
  return text;
}

}  // namespace pfdm
