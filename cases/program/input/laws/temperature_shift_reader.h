#pragma once
// temperature_shift of a material: how its relaxation times depend on the temperature.

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "physics/materials/temperature_shift.h"

#include <optional>
#include <string>
#include <string_view>

namespace pfdm {

/// Row of the key with its sentence, which names what tells the temperatures; `only`: as of a row.
Key temperature_shift_row(std::string_view sentence, std::string_view only = {});

/// Of a material; none without the key.
std::optional<TemperatureShift> read_temperature_shift(const ConfigTable& material);

/// "WLF, C1 8.9, C2 101.6 K from 298.15 K"
std::string words_of(const TemperatureShift& shift);

/// The key as it is read, with this many digits.
std::string to_toml(const TemperatureShift& shift, int digits);

}  // namespace pfdm
