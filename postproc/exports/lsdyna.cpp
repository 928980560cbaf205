// LS-DYNA. *MAT_138 as in Altair's import reference (help.altair.com/hwsolvers/rad/topics/solvers/rad/
// mat_138_cohesive_mixed_mode_lsdyna_r.htm), *MAT_186 and *DEFINE_CURVE as in the keyword classes of ansys/pydyna
// (mat_138.py, mat_cohesive_general.py): MID RO ROFLG INTFAIL EN ET GIC GIIC, XMU T S UND UTD GAMMA; MID RO ROFLG
// INTFAIL TES TSLC GIC GIIC, XMU T S STFSF TSLC2. Fields of 10 characters, of the curve's points 20.
//
// *MAT_138 (the equations as in sigeps117.F90 of OpenRadioss, whose law 117 it is read as), b = delta_s/delta_n:
//   T_n = (1 - D) EN delta_n, T_s = (1 - D) ET delta_s, (EN delta_n/T)^2 + (ET delta_s/S)^2 = 1 at the onset delta_0,
//   end, XMU > 0: 2 (1 + b^2)/delta_0 ((EN/GIC)^XMU + (ET b^2/GIIC)^XMU)^(-1/XMU),
//   XMU < 0: Benzeggagh and Kenane's of the work's share, exponent |XMU|; linear in between.
// *MAT_186: TSLC is normalised in both coordinates; the final separations are GIC/(A T) and GIIC/(A S) with its area A.
// TES 2: T_i = T_i,max TSLC(l)/l (delta_i/final_i), l^2 = sum (delta_i/final_i)^2; TES 0 power law, 1 Benzeggagh and
// Kenane. TES and the sign of XMU are those of the keyword manual, which is not public as a page.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/law/mode_remarks.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

#include <initializer_list>
#include <string>

namespace pfdm {
namespace {

constexpr int field = 10, point = 20;
constexpr int curve_id = 1;

std::string reals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += real_field(value, field);
  return text;
}

/// RO is of no law: a film of 1 um and 1000 kg/m^3, per area.
std::string first_fields(int material, const UnitSystem& units) {
  const double density = 1e-3 / units.mass * units.length * units.length;
  return integer_field(material, field) + reals({density}) + integer_field(1, field) + reals({1.0});
}

/// The sign selects the rule; 1: the energies of the modes add linearly.
double xmu_of(const ExportedLaw& law) {
  if (law.mix == ModeMix::one_energy) return 1.0;
  return law.mix == ModeMix::power_law ? law.exponent.value : -law.exponent.value;
}

std::string mat_138(const ExportedLaw& law, const UnitSystem& units) {
  return "*MAT_COHESIVE_MIXED_MODE\n$#     mid        ro     roflg   intfail        en        et       gic      "
         "giic\n" +
         first_fields(1, units) +
         reals({law.stiffness.value, law.shear_stiffness.value, law.energy.value, law.shear_energy.value}) +
         "\n$#     xmu         t         s       und       utd     gamma\n" +
         reals({xmu_of(law), law.strength.value, law.shear_strength.value, 0.0, 0.0, 1.0}) + "\n";
}

/// Dimensionless separations for one energy, power law, Benzeggagh and Kenane.
double tes_of(const ExportedLaw& law) {
  if (law.mix == ModeMix::one_energy) return 2.0;
  return law.mix == ModeMix::power_law ? 0.0 : 1.0;
}

std::string mat_186(const ExportedLaw& law, const UnitSystem& units) {
  return "*MAT_COHESIVE_GENERAL\n$#     mid        ro     roflg   intfail       tes      tslc       gic      giic\n" +
         first_fields(2, units) + reals({tes_of(law)}) + integer_field(curve_id, field) +
         reals({law.energy.value, law.shear_energy.value}) + "\n$#     xmu         t         s     stfsf     tslc2\n" +
         reals({law.exponent.value, law.strength.value, law.shear_strength.value, 0.0}) + "\n";
}

/// Its curve rises alike in both modes, over separations that end at GIC/(A T) and GIIC/(A S).
std::string mat_186_remark(const ExportedLaw& law) {
  if (law.mix == ModeMix::one_energy)
    return "*MAT_186: TES 2, separations over their final values: Camacho and Ortiz' rule while GIIC = GIC, without "
           "XMU.";
  const double b = law.shear_ratio();
  return fmt::format("*MAT_186: TES {}, {} with exponent XMU. ", tes_of(law), name_of(law.mix)) +
         shear_stiffness_remark(law, b * b * law.energy.value / law.shear_energy.value * law.stiffness.value) +
         " Between the modes its tractions were not compared with the law's.";
}

std::string curve(const ExportedLaw& law) {
  std::string text = "*DEFINE_CURVE\n$#    lcid      sidr       sfa       sfo      offa      offo    dattyp\n" +
                     integer_field(curve_id, field) + "\n$#                a1                  o1\n";
  for (const TractionPoint& p : law.curve)
    text += real_field(p.separation / law.curve.back().separation, point) +
            real_field(p.traction / law.strength.value, point) + "\n";
  return text;
}

}  // namespace

std::string lsdyna_input(const ExportedLaw& law, const UnitSystem& units) {
  return comment_lines(
             "*MAT_138: EN, ET stiffness per area; XMU > 0: power law of the energies, one energy for all while GIIC = "
             "GIC; XMU < 0: Benzeggagh and Kenane with exponent |XMU|. " +
                 quadratic_strength_remark(law) + " " + mat_186_remark(law) +
                 " RO belongs to no law: with ROFLG 1 the mass per area of a film of 1 um and 1000 kg/m^3; give yours.",
             "$") +
         "*KEYWORD\n" + mat_138(law, units) + mat_186(law, units) + curve(law) + "*END\n";
}

}  // namespace pfdm
