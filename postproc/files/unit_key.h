#pragma once

#include <string>

namespace pfdm {

/// "rms_force_N", the key of a quantity in JSON; one without a unit ("1") has its name alone.
inline std::string key_with_unit(const std::string& quantity, const std::string& unit) {
  return unit == "1" ? quantity : quantity + "_" + unit;
}

}  // namespace pfdm
