// MOOSE. Parameters as in modules/solid_mechanics/src/materials/cohesive_zone_model/BiLinearMixedModeTraction.C of
// idaholab/moose (Camanho, Davila, NASA/TM-2002-211737): the final separation is 2 Gc / (K onset), so that GI_c is the
// whole area; one stiffness for all modes, T = (1 - d) K delta; onset where the squares of the tractions over their
// strengths add up to one; mixed_mode_criterion BK or POWER_LAW of the separations' ratio.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/law/mode_remarks.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

namespace pfdm {

std::string moose_input(const ExportedLaw& law, const UnitSystem&) {
  return comment_lines(
             std::string(
                 "boundary: the interface of your mesh, split by BreakMeshByBlockGenerator; the kernels are those "
                 "of [Physics/SolidMechanics/CohesiveZone]. ") +
                 one_stiffness_remark(law) + " " + quadratic_strength_remark(law),
             "#") +
         fmt::format("[Materials]\n  [{}_traction_separation]\n    type = BiLinearMixedModeTraction\n", law.surface) +
         fmt::format(
             "    boundary = interface\n    penalty_stiffness = {}\n    normal_strength = {}\n"
             "    shear_strength = {}\n    GI_c = {}\n    GII_c = {}\n    mixed_mode_criterion = {}\n"
             "    eta = {}\n  []\n[]\n",
             deck_number(law.stiffness.value), deck_number(law.strength.value), deck_number(law.shear_strength.value),
             deck_number(law.energy.value), deck_number(law.shear_energy.value),
             law.mix == ModeMix::power_law ? "POWER_LAW" : "BK", deck_number(law.exponent.value));
}

}  // namespace pfdm
