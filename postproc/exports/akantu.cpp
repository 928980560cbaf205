// Akantu. Parameters as in its manual, constitutive laws, cohesive_linear (kappa = G_cII/G_cI), and in
// material_cohesive_linear.cc and material_cohesive_bilinear.cc (delta_0): T = sigma_c (1 - Delta/delta_c) with Delta^2
// = (beta/kappa)^2 delta_t^2 + delta_n^2 and delta_c = 2 G_c/sigma_c, so that the shear strength is beta sigma_c and
// the energy of mode II kappa G_c; T_n = sigma delta_n/Delta, T_s = beta^2/kappa sigma delta_t/Delta. With kappa = 1 it
// is Camacho and Ortiz' rule. penalty is the stiffness in compression.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/law/mode_remarks.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

std::string parameters(const ExportedLaw& law) {
  return fmt::format("    name = {}\n    sigma_c = {}\n    beta = {}\n    G_c = {}\n    kappa = {}\n    penalty = {}\n",
                     law.surface, deck_number(law.strength.value),
                     deck_number(law.shear_strength.value / law.strength.value), deck_number(law.energy.value),
                     deck_number(law.shear_energy.value / law.energy.value), deck_number(law.stiffness.value));
}

/// In shear the rise is beta^2/kappa times as stiff.
std::string akantu_remark(const ExportedLaw& law) {
  if (law.mix == ModeMix::one_energy) return "";
  const double b = law.shear_ratio(), kappa = law.shear_energy.value / law.energy.value;
  return fmt::format("Strength and energy are the law's in each mode alone; between them kappa mixes, and not {}. ",
                     name_of(law.mix)) +
         shear_stiffness_remark(law, b * b / kappa * law.stiffness.value);
}

std::string as_comment(std::string text) {
  for (std::size_t i = 0; i < text.size(); i = text.find('\n', i) + 1) text.insert(i, "# ");
  return text;
}

}  // namespace

std::string akantu_input(const ExportedLaw& law, const UnitSystem&) {
  return comment_lines(
             "Into your material file, beside the materials of the bodies. cohesive_linear is for elements that "
             "are inserted where sigma_c is reached (extrinsic): it has no rise. Elements that are there from the "
             "beginning (intrinsic): the second. " +
                 akantu_remark(law),
             "#") +
         fmt::format("material cohesive_linear [\n{}]\n", parameters(law)) +
         as_comment(fmt::format("material cohesive_bilinear [\n{}    delta_0 = {}\n]\n", parameters(law),
                                deck_number(law.onset())));
}

}  // namespace pfdm
