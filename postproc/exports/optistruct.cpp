// OptiStruct. MCOHE as in Altair's reference guide, bulk data, MCOHE (2021.2: help.altair.com/hwsolvers/os/topics/
// solvers/os/mcohe_bulk_r.htm): MID, MODEL 1 (bilinear); COHE, the area under the curve; CRTOD, MAXOD; BETA, the
// coefficient of the shear opening in the effective one; SFC. Fields of 16 characters ("large field fixed format" of
// the bulk data guidelines). MCOHED with DMGINI and DMGEVO is not written: its releases order the directions
// differently.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/export_head.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

constexpr int wide = 16;
constexpr std::string_view blank = "                ";

}  // namespace

std::string optistruct_input(const ExportedLaw& law, const UnitSystem&) {
  return comment_lines(
             "Peak traction 2 COHE/MAXOD, at CRTOD. One energy for all modes: GII and the exponent have no "
             "place. BETA is shear strength over strength. SFC: in compression the stiffness of the rise. "
             "PCOHE refers to MID.",
             "$") +
         fmt::format("{:<8}{}{}\n", "MCOHE*", integer_field(1, wide), integer_field(1, wide)) + "*\n" +
         fmt::format("{:<8}{}{}{}{}\n", "*", real_field(law.energy.value, wide), real_field(law.onset(), wide),
                     real_field(law.final_separation(), wide),
                     real_field(law.shear_strength.value / law.strength.value, wide)) +
         fmt::format("{:<8}{}{}{}{}\n", "*", blank, blank, blank, real_field(-1.0, wide));
}

}  // namespace pfdm
