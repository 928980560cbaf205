#include "cases/program/fracture/case/heat_case.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/body_loads.h"
#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/config/key_member.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

constexpr Range share_range{0.0, 1.0, true, "above 0 and below 1"};
constexpr Range steps_range{1.0, 1e6, false, "between 1 and 1e6"};

const KeyTable& heat_boundary_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "heat.boundary[]",
      .sentence = "What heat does on patches of the mesh; patches that no entry names are insulated.",
      .keys = {{"patch", text("patch"), "or patches", "Name of the patch of the mesh that the condition is for."},
               {"patches", list(text("patch"), 1), "or patch", "Names of the patches that the condition is for."},
               {"rise", quantity(dimension::temperature_difference), "or flux, heat_transfer",
                "Temperature of the patch above that of the start, a difference in K."},
               {"flux", quantity(dimension::heat_flux), "or rise, heat_transfer",
                "Heat flux through the patch into the body."},
               {"heat_transfer", quantity(dimension::heat_transfer, range::positive), "or rise, flux",
                "Heat transfer coefficient to the surroundings, as by convection."},
               {"surroundings", quantity(dimension::temperature_difference), "\"0 K\"",
                "Temperature beyond a heat transfer above that of the start, a difference in K."}}};
  return table;
}

DiffusionBoundary read_condition(const ConfigTable& table) {
  using Kind = DiffusionBoundary::Kind;
  constexpr std::array kinds{std::pair("rise", Kind::value), std::pair("flux", Kind::flux),
                             std::pair("heat_transfer", Kind::exchange)};
  const auto is_given = [&](const auto& kind) { return table.has(kind.first); };
  if (std::ranges::count_if(kinds, is_given) != 1) throw table.error("expected one of rise, flux and heat_transfer");
  const auto& [key, kind] = *std::ranges::find_if(kinds, is_given);
  for (const char* difference : {"rise", "surroundings"})
    if (const auto value = table.find(difference)) require_temperature_difference(*value);
  DiffusionBoundary on{.patch = {}, .kind = kind, .value = table.quantity(key)};
  if (kind == Kind::exchange) {
    on.coefficient = on.value;
    on.value = table.quantity("surroundings", 0.0);
  } else if (const auto value = table.find("surroundings")) {
    throw value->error("this belongs to a heat_transfer");
  }
  return on;
}

void read_boundary_of(const ConfigTable& table, std::vector<DiffusionBoundary>& boundary) {
  if (table.has("patch") == table.has("patches")) throw table.error("give either patch or patches");
  DiffusionBoundary on = read_condition(table);
  const std::vector<ConfigValue> patches =
      table.has("patch") ? std::vector{table.at("patch")} : table.at("patches").list();
  for (const ConfigValue& patch : patches) {
    on.patch = patch.string();
    if (std::ranges::find(boundary, on.patch, &DiffusionBoundary::patch) != boundary.end())
      throw patch.error(fmt::format("patch \"{}\" already has a condition for heat", on.patch));
    boundary.push_back(on);
  }
}

void check_cycles(const ConfigTable& table, const HeatModel& heat, const LoadingSettings& loading) {
  const double cycle = heat.cycle;
  if (!(cycle > 0.0))
    for (const char* key : {"time", "time_steps", "repeats_within"})
      if (const auto value = table.find(key))
        throw value->error(
            "this belongs to a load with cycles; give the load parameter that a cycle takes, as in cycle = 1");
  if (cycle > 0.0 && loading.end < 2.0 * cycle * (1.0 - 1e-9))
    throw table.at("cycle").error(
        fmt::format("whether a cycle repeats is told from two; the loading ends at {:g}: loading.end = {:g} or more",
                    loading.end, 2.0 * cycle));
  if (table.has("time_steps") && !table.has("time")) throw table.at("time_steps").error("this belongs to a time");
  if (table.has("changes_within") && !(heat.is_two_way && heat.time > 0.0))
    throw table.at("changes_within").error("this belongs to coupling = \"two_way\" with a time");
}

}  // namespace

const KeyTable& heat_keys() {
  using namespace keys;
  using M = HeatModel;
  static const KeyTable table{
      .name = "heat",
      .sentence = "Heat of what a body dissipates: where it is made, how it flows, cycles of load and a long time.",
      .keys = {
          {"boundary", tables(heat_boundary_keys), "all patches insulated",
           "Conditions for heat on patches: a temperature rise, a flux, a heat transfer."},
          {"closed_conductance",
           either({quantity(dimension::heat_transfer, range::positive), choice("conductance", {"perfect"})}),
           "\"perfect\"", "Thermal conductance of cohesive interfaces that are bonded or touch."},
          stored<&M::open_conductance>("open_conductance", quantity(dimension::heat_transfer, range::not_negative),
                                       "Thermal conductance of cohesive interfaces that have debonded and are open.",
                                       "\"0 W/m^2/K\""),
          stored<&M::debonding_share>(
              "debonding_share", number(range::fraction),
              "Share of what the decohesion of interfaces dissipates that is heat; friction all is.", "1"),
          stored<&M::cycle>("cycle", number(range::positive),
                            "Load parameter that a cycle of the load takes; the run ends once its heat repeats.",
                            "none: no cycles"),
          stored<&M::repeats_within>(
              "repeats_within", number(share_range),
              "Change of a cycle's heat from the one before, over all cells, below which it repeats; relative."),
          stored<&M::time>("time", quantity(dimension::time, range::positive),
                           "Time for which the mean heat of the last cycle then warms the body.", "none"),
          stored<&M::time_steps>("time_steps", whole(steps_range), "Number of equal steps of that time."),
          {"coupling", choice("coupling of heat and stress", {"one_way", "two_way"}), "\"one_way\"",
           "Whether rises of the temperature also act on the body: by expansion and by temperature_shift."},
          stored<&M::changes_within>(
              "changes_within", number(share_range),
              "Change of a cycle's shear moduli or heat, relative, from which on it is gone through "
              "again within the time; of coupling \"two_way\"."),
      }};
  return table;
}

std::optional<HeatModel> read_heat(const ConfigTable& root, const LoadingSettings& loading) {
  if (!root.has("heat")) return std::nullopt;
  const ConfigTable table = root.table("heat");
  HeatModel heat;
  read_stored(table, heat);
  heat.is_two_way = table.choice("coupling", "one_way") == "two_way";
  if (const auto closed = table.find("closed_conductance");
      closed && !(closed->is_string() && closed->string() == "perfect"))
    heat.closed_conductance = closed->quantity();
  for (const ConfigTable& on : table.tables("boundary")) read_boundary_of(on, heat.boundary);
  if (!(loading.duration > 0.0))
    throw table.error("heat requires the time in which the load parameter grows by 1: duration = \"1 s\" in [loading]");
  check_cycles(table, heat, loading);
  return heat;
}

}  // namespace pfdm
