#pragma once
// The dimensions of what conducts and exchanges heat, and of what temperatures change.

#include "cases/program/input/config/units.h"

namespace pfdm::dimension {

inline constexpr Dimension conductivity{"thermal conductivity", "W/m/K", "0.25 W/m/K"};
inline constexpr Dimension specific_heat{"specific heat", "J/kg/K", "1600 J/kg/K"};
inline constexpr Dimension heat_transfer{"heat transfer coefficient", "W/m^2/K", "10 W/m^2/K"};
inline constexpr Dimension heat_flux{"heat flux", "W/m^2", "100 W/m^2"};
inline constexpr Dimension molar_energy{"molar energy", "J/mol", "60 kJ/mol"};
/// In K: a temperature in degC is none.
inline constexpr Dimension temperature_difference{"temperature difference", "K", "20 K"};
inline constexpr Dimension per_temperature{"relative change with temperature", "1/K", "-0.01 1/K"};

}  // namespace pfdm::dimension
