// LS-DYNA. *MAT_138 as in Altair's import reference (help.altair.com/hwsolvers/rad/topics/solvers/rad/
// mat_138_cohesive_mixed_mode_lsdyna_r.htm), *MAT_186 and *DEFINE_CURVE as in the keyword classes of ansys/pydyna
// (mat_138.py, mat_cohesive_general.py): MID RO ROFLG INTFAIL EN ET GIC GIIC, XMU T S UND UTD GAMMA; MID RO ROFLG
// INTFAIL TES TSLC GIC GIIC, XMU T S STFSF TSLC2. Fields of 10 characters, of the curve's points 20. TSLC is normalised
// in both coordinates; the code gets the final separation from GIC, T and the curve's area.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/export_head.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

#include <initializer_list>

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

std::string mat_138(const ExportedLaw& law, const UnitSystem& units) {
  return "*MAT_COHESIVE_MIXED_MODE\n$#     mid        ro     roflg   intfail        en        et       gic      "
         "giic\n" +
         first_fields(1, units) +
         reals({law.stiffness.value, law.stiffness.value, law.energy.value, law.shear_energy.value}) +
         "\n$#     xmu         t         s       und       utd     gamma\n" +
         reals({1.0, law.strength.value, law.shear_strength.value, 0.0, 0.0, 1.0}) + "\n";
}

std::string mat_186(const ExportedLaw& law, const UnitSystem& units) {
  return "*MAT_COHESIVE_GENERAL\n$#     mid        ro     roflg   intfail       tes      tslc       gic      giic\n" +
         first_fields(2, units) + reals({2.0}) + integer_field(curve_id, field) +
         reals({law.energy.value, law.shear_energy.value}) + "\n$#     xmu         t         s     stfsf     tslc2\n" +
         reals({law.exponent.value, law.strength.value, law.shear_strength.value, 0.0}) + "\n";
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
             "*MAT_138: EN, ET stiffness per area; XMU 1: modes add linearly, with one energy for all while GIIC = "
             "GIC. The exponent of Benzeggagh and Kenane has no place in it: the sign of XMU that selects this form "
             "could not be verified in a public source. *MAT_186: TES 2, Benzeggagh and Kenane with exponent XMU. RO "
             "belongs to no law: with ROFLG 1 the mass per area of a film of 1 um and 1000 kg/m^3; give yours.",
             "$") +
         "*KEYWORD\n" + mat_138(law, units) + mat_186(law, units) + curve(law) + "*END\n";
}

}  // namespace pfdm
