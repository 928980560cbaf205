#include "cases/program/fracture/body/fatigue_case.h"

#include "cases/program/input/config/key_member.h"

namespace pfdm {
namespace {

constexpr Range parts_range{1.0, 1e6, false, "between 1 and 1e6"};
constexpr Range toughness_fall_range{0.0, 1.0, true, "above 0 and below 1"};

}  // namespace

const KeyTable& fatigue_cycle_keys() {
  using namespace keys;
  using C = FatigueCycles;
  static const KeyTable table{
      .name = "fatigue",
      .sentence = "The cycles of the load of a body with fatigue, and jumps over them.",
      .keys = {
          {"cycle", number(range::positive), "", "Load parameter that a cycle of the load takes."},
          stored<&C::steps>("steps", whole(parts_range),
                            "Number of equal parts of a cycle at whose ends a step ends; the peaks of the load are to "
                            "be among them."),
          stored<&C::jump_tolerance>("jump_tolerance", number(toughness_fall_range),
                                     "Largest fall of any cell's toughness factor f by a jump over cycles.",
                                     "none: every cycle is computed"),
          stored<&C::computed_cycles>("computed_cycles", whole(parts_range),
                                      "Least number of cycles that are computed before and between jumps."),
      }};
  return table;
}

FatigueCycles read_fatigue_cycles(const ConfigTable& root, const Materials& materials) {
  FatigueCycles cycles;
  if (!root.has("fatigue")) return cycles;
  const ConfigTable table = root.table("fatigue");
  read_stored(table, cycles);
  cycles.cycle = table.number("cycle");
  if (!materials.has_fatigue())
    throw table.error(
        "no damageable material has fatigue; give one fatigue = { law = \"asymptotic\", threshold = \"50 kJ/m^3\" }, "
        "or leave out [fatigue]");
  if (const auto computed = table.find("computed_cycles"); computed && !(cycles.jump_tolerance > 0.0))
    throw computed->error("this belongs to jumps over cycles; give jump_tolerance, as in jump_tolerance = 0.02");
  return cycles;
}

}  // namespace pfdm
