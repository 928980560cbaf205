#include "postproc/exports/law/export_head.h"

#include <fmt/format.h>

#include <sstream>

namespace pfdm {
namespace {

constexpr std::size_t width = 79;

std::string figure_line(std::string_view name, const Figure& figure, std::string_view unit) {
  return fmt::format("{} = {:.6g}{}{}: {}", name, figure.value, unit.empty() ? "" : " ", unit, figure.basis);
}

}  // namespace

ExportedLaw in_units(ExportedLaw law, const UnitSystem& units) {
  law.stiffness.value /= units.stiffness();
  law.shear_stiffness.value /= units.stiffness();
  law.strength.value /= units.stress;
  law.shear_strength.value /= units.stress;
  law.energy.value /= units.energy();
  law.shear_energy.value /= units.energy();
  law.initiation /= units.stress;
  for (TractionPoint& p : law.curve) p = {p.separation / units.length, p.traction / units.stress};
  for (DamagePoint& p : law.damage) p.separation /= units.length;
  return law;
}

std::vector<std::string> export_head(const ExportedLaw& law, const UnitSystem& units) {
  std::vector<std::string> head = law.remarks;
  const std::string stiffness_unit = fmt::format("{}/{}", units.stress_name, units.length_name);
  head.push_back(
      fmt::format("Units of this file: {} (length {}, stress {}, energy per area {}, stiffness per area {}); "
                  "of the lines above: SI",
                  units.name, units.length_name, units.stress_name, units.energy_name, stiffness_unit));
  head.push_back(figure_line("stiffness", law.stiffness, stiffness_unit));
  head.push_back(figure_line("shear stiffness", law.shear_stiffness, stiffness_unit));
  head.push_back(figure_line("strength", law.strength, units.stress_name));
  head.push_back(figure_line("shear strength", law.shear_strength, units.stress_name));
  head.push_back(figure_line("GI", law.energy, units.energy_name));
  head.push_back(figure_line("GII", law.shear_energy, units.energy_name));
  head.push_back(figure_line("exponent", law.exponent, ""));
  head.push_back(fmt::format("Modes are mixed by {} ({} of pfdm) unless this file says otherwise below",
                             name_of(law.mix), law.rule));
  head.push_back(fmt::format(
      "Bilinear law: rise to {:.6g} {}, zero at {:.6g} {}; it has the strength and GI, and not the shape of the {}",
      law.onset(), units.length_name, law.final_separation(), units.length_name, law.origin));
  head.push_back(fmt::format(
      "Tables, where this format takes them: T-delta in {} points, within {:.2g} % of the strength at the states "
      "of the {}, area {:.6g} {}; D-delta in {} points, within {:.2g} %, area {:.6g}; they begin with the stiffness "
      "above",
      law.curve.size(), 100.0 * law.curve_error, law.origin, area_under(law.curve), units.energy_name,
      law.damage.size(), 100.0 * law.damage_error, area_under(law.damage, law.stiffness.value)));
  return head;
}

std::string comment_lines(std::string_view text, std::string_view prefix) {
  std::istringstream words{std::string(text)};
  std::string lines, line(prefix);
  for (std::string word; words >> word;) {
    if (line.size() > prefix.size() && line.size() + 1 + word.size() > width) {
      lines += line + "\n";
      line = std::string(prefix) + "   ";
    }
    line += (line.ends_with(' ') ? "" : " ") + word;
  }
  return lines + line + "\n";
}

}  // namespace pfdm
