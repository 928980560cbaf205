#pragma once

#include <numbers>

namespace pfdm {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]

}  // namespace pfdm
