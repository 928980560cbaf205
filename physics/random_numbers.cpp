#include "physics/random_numbers.h"

#include "physics/portable_math.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace pfdm {

double RandomNumbers::normal() {
  const double radius = std::sqrt(-2.0 * portable::log(1.0 - uniform()));
  return radius * portable::cos(2.0 * std::numbers::pi * uniform());
}

// A unit quaternion of four normal numbers.
Tensor RandomNumbers::rotation() {
  const double w = normal(), x = normal(), y = normal(), z = normal();
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

}  // namespace pfdm
