// A table for any code that interpolates: the points of T-delta and those of D-delta, with both columns in each row.
#include "postproc/exports/deck_number.h"
#include "postproc/exports/export_head.h"
#include "postproc/exports/writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace pfdm {

std::string table_input(const ExportedLaw& law, const UnitSystem& units) {
  std::vector<DamagePoint> rows{{0.0, 0.0}};
  rows.insert(rows.end(), law.damage.begin(), law.damage.end());
  std::string text = comment_lines("T = (1 - D) K delta with D linear between the rows", "#") +
                     comment_lines(fmt::format("as [[interface]] of pfdm (in SI): law = \"table\", table = this file, "
                                               "shear_ratio = {:.4g}",
                                               law.shear_strength.value / law.strength.value),
                                   "#") +
                     fmt::format("separation_{},traction_{},damage\n", units.length_name, units.stress_name);
  for (const DamagePoint& p : rows)
    text += fmt::format("{},{},{}\n", deck_number(p.separation),
                        deck_number((1.0 - p.damage) * law.stiffness.value * p.separation), deck_number(p.damage));
  return text;
}

}  // namespace pfdm
