// A table for any code that interpolates: the points of T-delta and those of D-delta, with both columns in each row.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/law/export_head.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace pfdm {

namespace {

/// The keys of an interface of pfdm with this table.
std::string as_interface(const ExportedLaw& law) {
  std::string keys = "as [[interface]] of pfdm (in SI): law = \"table\", table = this file";
  if (law.rule == "equal_stiffness") keys += ", mixed_mode = \"equal_stiffness\"";
  if (law.mix == ModeMix::one_energy || law.rule == "equal_stiffness")
    return keys + fmt::format(", shear_ratio = {:.6g}", law.shear_ratio());
  return keys + fmt::format(". It is the law in opening: {} has no place beside a table", name_of(law.mix));
}

}  // namespace

std::string table_input(const ExportedLaw& law, const UnitSystem& units) {
  std::vector<DamagePoint> rows{{0.0, 0.0}};
  rows.insert(rows.end(), law.damage.begin(), law.damage.end());
  std::string text = comment_lines("T = (1 - D) K delta with D linear between the rows", "#") +
                     comment_lines(as_interface(law), "#") +
                     fmt::format("separation_{},traction_{},damage\n", units.length_name, units.stress_name);
  for (const DamagePoint& p : rows)
    text += fmt::format("{},{},{}\n", deck_number(p.separation),
                        deck_number((1.0 - p.damage) * law.stiffness.value * p.separation), deck_number(p.damage));
  return text;
}

}  // namespace pfdm
