#pragma once
// temperature_shift of a material: how its relaxation times depend on the temperature.

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "physics/materials/temperature_shift.h"

#include <optional>
#include <string_view>

namespace pfdm {

/// Row of the key; `only`: as of a row.
Key temperature_shift_row(std::string_view only);

/// Of a material; none without the key.
std::optional<TemperatureShift> read_temperature_shift(const ConfigTable& material);

}  // namespace pfdm
