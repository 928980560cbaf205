#include "cases/program/input/laws/temperature_shift_reader.h"

#include "cases/program/input/config/heat_units.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

const KeyTable& shift_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "temperature_shift",
      .sentence = "Factor a_T of all relaxation times by the temperature.",
      .keys = {{"law", choice("law of a temperature shift", {"wlf", "arrhenius"}), "",
                "Williams-Landel-Ferry, or Arrhenius with an activation energy."},
               {"reference", quantity(dimension::temperature, range::positive), "",
                "Temperature at which the branches have their times, as in \"25 degC\"."},
               {"C1", number(range::positive), "", "First constant of WLF: log10 a_T = -C1 dT/(C2 + dT).", "wlf"},
               {"C2", quantity(dimension::temperature_difference, range::positive), "",
                "Second constant of WLF, a difference in K.", "wlf"},
               {"activation_energy", quantity(dimension::molar_energy, range::positive), "",
                "Activation energy E of Arrhenius: ln a_T = E/R (1/T - 1/reference).", "arrhenius"}},
      .decided_by = "law"};
  return table;
}

}  // namespace

Key temperature_shift_row(std::string_view sentence, std::string_view only) {
  return {"temperature_shift", keys::table(shift_keys), "none", sentence, only};
}

std::optional<TemperatureShift> read_temperature_shift(const ConfigTable& material) {
  if (!material.has("temperature_shift")) return std::nullopt;
  const ConfigTable table = material.table("temperature_shift");
  TemperatureShift shift{.reference = table.quantity("reference")};
  if (table.choice("law") == "arrhenius") {
    shift.law = TemperatureShift::Law::arrhenius;
    shift.activation_energy = table.quantity("activation_energy");
  } else {
    if (const ConfigValue c2 = table.at("C2"); has_other_zero(unit_of(c2.string())))
      throw c2.error("C2 is a difference of temperatures: give it in K, as in \"20 K\"");
    shift.c1 = table.number("C1");
    shift.c2 = table.quantity("C2");
  }
  return shift;
}

std::string words_of(const TemperatureShift& shift) {
  const std::string reference = quantity_text(shift.reference, "K", 5);
  if (shift.law == TemperatureShift::Law::arrhenius)
    return fmt::format("Arrhenius, {} from {}", quantity_text(shift.activation_energy, "J/mol", 4), reference);
  return fmt::format("WLF, C1 {:.4g}, C2 {} from {}", shift.c1, quantity_text(shift.c2, "K", 4), reference);
}

std::string to_toml(const TemperatureShift& shift, int digits) {
  const std::string reference = quantity_text(shift.reference, "K", digits);
  if (shift.law == TemperatureShift::Law::arrhenius)
    return fmt::format(
        "temperature_shift = {{ law = \"arrhenius\", reference = \"{}\", activation_energy = \"{}\" }}\n", reference,
        quantity_text(shift.activation_energy, "J/mol", digits));
  return fmt::format("temperature_shift = {{ law = \"wlf\", reference = \"{}\", C1 = {:.{}g}, C2 = \"{}\" }}\n",
                     reference, shift.c1, digits, quantity_text(shift.c2, "K", digits));
}

}  // namespace pfdm
