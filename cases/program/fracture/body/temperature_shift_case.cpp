#include "cases/program/fracture/body/temperature_shift_case.h"

#include "cases/program/fracture/body/body_loads.h"
#include "cases/program/input/config/heat_units.h"

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

Key temperature_shift_row(std::string_view only) {
  return {"temperature_shift", keys::table(shift_keys), "none",
          "How the times of all branches depend on the temperature; needs loads.start_temperature.", only};
}

std::optional<TemperatureShift> read_temperature_shift(const ConfigTable& material) {
  if (!material.has("temperature_shift")) return std::nullopt;
  const ConfigTable table = material.table("temperature_shift");
  TemperatureShift shift{.reference = table.quantity("reference")};
  if (table.choice("law") == "arrhenius") {
    shift.law = TemperatureShift::Law::arrhenius;
    shift.activation_energy = table.quantity("activation_energy");
  } else {
    require_temperature_difference(table.at("C2"));
    shift.c1 = table.number("C1");
    shift.c2 = table.quantity("C2");
  }
  return shift;
}

}  // namespace pfdm
