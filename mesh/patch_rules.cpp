#include "mesh/patch_rules.h"

#include <fmt/format.h>

#include <cmath>

#include "physics/error.h"

namespace pfdm {

PatchRule plane_patch(std::string name, int axis, double value, double tolerance) {
  if (axis < 0 || axis > 2) throw InputError(fmt::format("patch \"{}\": axis {} is not 0, 1 or 2", name, axis));
  return {std::move(name),
          [axis, value, tolerance](const Vector& centre, const Vector& normal, std::span<const Index>) {
            return std::abs(centre[axis] - value) <= tolerance && std::abs(normal[axis]) > 0.99;
          }};
}

PatchRule patch_within(std::string name, const Vector& lower, const Vector& upper, double tolerance) {
  const Vector least = lower.array() - tolerance, most = upper.array() + tolerance;
  return {std::move(name), [least, most](const Vector& centre, const Vector&, std::span<const Index>) {
            return (centre.array() >= least.array()).all() && (centre.array() <= most.array()).all();
          }};
}

std::vector<PatchRule> box_patches(const Vector& lower, const Vector& upper) {
  const double tolerance = 1e-6 * (upper - lower).norm();
  std::vector<PatchRule> rules;
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = static_cast<char>('x' + axis);
    rules.push_back(plane_patch(fmt::format("{}min", letter), axis, lower[axis], tolerance));
    rules.push_back(plane_patch(fmt::format("{}max", letter), axis, upper[axis], tolerance));
  }
  return rules;
}

}  // namespace pfdm
