#pragma once
// Consistent systems of units that input files of other codes are written in.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct UnitSystem {
  std::string_view name;
  double length;                 ///< its unit of length [m]
  double stress;                 ///< [Pa]
  double mass;                   ///< [kg]
  std::string_view length_name;  ///< "mm"
  std::string_view stress_name;
  std::string_view energy_name;  ///< per area
  std::string_view mass_name;

  double energy() const { return stress * length; }     ///< per area [J/m^2]
  double stiffness() const { return stress / length; }  ///< per area [Pa/m]
};

std::span<const UnitSystem> unit_systems();
std::vector<std::string> names_of_unit_systems();

/// Throws InputError with the names there are.
const UnitSystem& unit_system(std::string_view name);

}  // namespace pfdm
