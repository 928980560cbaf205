#include "postproc/exports/law/unit_systems.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

// To add a system: a row.
constexpr UnitSystem systems[] = {
    {"SI", 1.0, 1.0, 1.0, "m", "Pa", "J/m^2", "kg"},
    {"mm-N-s", 1e-3, 1e6, 1e3, "mm", "MPa", "N/mm", "tonne"},
    {"mm-kN-ms", 1e-3, 1e9, 1.0, "mm", "GPa", "kN/mm", "kg"},
    {"um-uN-s", 1e-6, 1e6, 1.0, "um", "MPa", "uN/um", "kg"},
};

}  // namespace

std::span<const UnitSystem> unit_systems() { return systems; }

std::vector<std::string> names_of_unit_systems() {
  std::vector<std::string> names;
  for (const UnitSystem& system : systems) names.emplace_back(system.name);
  return names;
}

const UnitSystem& unit_system(std::string_view name) {
  const auto found = std::ranges::find(systems, name, &UnitSystem::name);
  if (found == std::end(systems))
    throw InputError(fmt::format("--units: there is no system of units \"{}\" (available: {})", name,
                                 fmt::join(names_of_unit_systems(), ", ")));
  return *found;
}

}  // namespace pfdm
