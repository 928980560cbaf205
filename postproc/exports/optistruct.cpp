// OptiStruct. MCOHE as in Altair's reference guide, bulk data, MCOHE (2021.2: help.altair.com/hwsolvers/os/topics/
// solvers/os/mcohe_bulk_r.htm): MID, MODEL 1 (bilinear); COHE, the area under the curve; CRTOD, MAXOD; BETA, the
// coefficient of the shear opening in the effective one, delta^2 = delta_n^2 + BETA^2 delta_s^2, whose potential gives
// T_n = T(delta)/delta delta_n and T_s = BETA^2 T(delta)/delta delta_s: Camacho and Ortiz' rule; SFC. Fields of 16
// characters ("large field fixed format" of the bulk data guidelines). MCOHED with DMGINI and DMGEVO is not written:
// its releases order the directions differently.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/law/mode_remarks.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

constexpr int wide = 16;
constexpr std::string_view blank = "                ";

std::string optistruct_remark(const ExportedLaw& law) {
  if (law.mix == ModeMix::one_energy) return "";
  return fmt::format(
             "One energy for all modes and BETA^2 times the stiffness in shear: GII, the exponent and {} have no "
             "place. ",
             name_of(law.mix)) +
         shear_stiffness_remark(law, law.shear_ratio() * law.shear_ratio() * law.stiffness.value);
}

}  // namespace

std::string optistruct_input(const ExportedLaw& law, const UnitSystem&) {
  return comment_lines(
             "Peak traction 2 COHE/MAXOD, at CRTOD. BETA is shear strength over strength. SFC: in compression the "
             "stiffness of the rise. PCOHE refers to MID. " +
                 optistruct_remark(law),
             "$") +
         fmt::format("{:<8}{}{}\n", "MCOHE*", integer_field(1, wide), integer_field(1, wide)) + "*\n" +
         fmt::format("{:<8}{}{}{}{}\n", "*", real_field(law.energy.value, wide), real_field(law.onset(), wide),
                     real_field(law.final_separation(), wide),
                     real_field(law.shear_strength.value / law.strength.value, wide)) +
         fmt::format("{:<8}{}{}{}{}\n", "*", blank, blank, blank, real_field(-1.0, wide));
}

}  // namespace pfdm
