#pragma once
// Boxes of one soft material that vibrate.

#include "tests/verification/support.h"

#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::vibrating_boxes {

inline constexpr double pi = std::numbers::pi, rho = 1200.0, E = 20e6;

inline Mesh box(const Vector& size, const std::array<Index, 3>& n) {
  BoxHexesSettings settings;
  for (std::size_t a = 0; a < 3; ++a) settings.axes[a] = {{size[a], n[a], 1.0}};
  return make_box_hexes(settings);
}

inline BoundaryCondition clamped(const std::string& patch) {
  return displacement_on(patch, [](const Vector&) -> Vector { return Vector::Zero(); });
}

/// The middle plane of an antisymmetric bending mode: nothing moves within it.
inline BoundaryCondition antisymmetric(const std::string& patch, std::size_t normal) {
  BoundaryCondition condition{.patch = patch, .displacement_prescribed = {true, true, true}, .value = {}};
  condition.displacement_prescribed[normal] = false;
  return condition;
}

inline ElasticBody body_of(double nu, std::vector<BoundaryCondition> boundary) {
  return {.elasticity = {from_young_poisson(E, nu)}, .zone = {0}, .boundary = std::move(boundary)};
}

}  // namespace pfdm::verification::vibrating_boxes
