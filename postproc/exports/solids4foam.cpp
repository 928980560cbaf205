// solids4foam (version c375333 of 2025-04-03). Dictionaries as in tutorials/solids/fracture/crackingBeams/0/D
// (solidCohesive, variableMixedMode) and crackingPlateHole/0/D (simpleCohesiveZone). variableMixedMode holds the
// traction at (T_n/sigmaMax)^2 + (T_s/tauMax)^2 = 1 until GI/GIc + GII/GIIc = 1 (variableMixedModeCohesiveZoneModel.C);
// linear is sigmaMax (1 - delta/deltaC), deltaC = 2 GIc/sigmaMax (linearSimpleCohesiveZoneLaw.C).
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

std::string entry(std::string_view name, std::string_view dimensions, double value) {
  return fmt::format("        {:<12}{} [ {} 0 0 0 0 ] {};\n", name, name, dimensions, deck_number(value));
}

constexpr std::string_view of_stress = "1 -1 -2", of_energy = "1 0 -2";

}  // namespace

std::string solids4foam_input(const ExportedLaw& law, const UnitSystem&) {
  return comment_lines(
             "Into boundaryField of 0/D, one or the other, with type, relaxationFactor and value of your patch. "
             "Cracks begin rigidly: the stiffnesses have no place. Modes: the squares of the tractions over their "
             "strengths add up to one, and so do the energies over theirs; no other rule has a place. "
             "variableMixedMode keeps strength and energy; "
             "its traction stays at the strength up to GI/strength (Dugdale). linear (mode I only) softens "
             "linearly to 2 GI/strength.",
             "//") +
         "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       dictionary;\n"
         "    object      solids4foam;\n}\n\nsolidCohesive\n{\n    cohesiveZoneModel\n    {\n"
         "        type        variableMixedMode;\n" +
         entry("sigmaMax", of_stress, law.strength.value) + entry("tauMax", of_stress, law.shear_strength.value) +
         entry("GIc", of_energy, law.energy.value) + entry("GIIc", of_energy, law.shear_energy.value) +
         "    }\n}\n\nsimpleCohesiveZone\n{\n    simpleCohesiveZoneLaw linear;\n    linearCoeffs\n    {\n" +
         entry("GIc", of_energy, law.energy.value) + entry("sigmaMax", of_stress, law.strength.value) + "    }\n}\n";
}

}  // namespace pfdm
