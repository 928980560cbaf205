#pragma once
// Elasticity that depends on the direction, as a material gives it, and the axes along which it is.

#include "cases/program/input/config/config.h"
#include "physics/elasticity/mandel.h"

#include <functional>

namespace pfdm {

/// Axes of a material: the columns at x [m].
struct MaterialAxes {
  std::function<Tensor(const Vector& x)> at;  ///< throws InputError where two of them are parallel
  bool varies = false;
};

/// The stiffness [Pa] along the axes: { E1 = "140 GPa", ..., nu12 = 0.3, ..., G12 = "5 GPa", ... }, of a cubic crystal
/// { C11 = "168 GPa", C12 = "121 GPa", C44 = "75 GPa" }, or { stiffness = [21 stresses] } in Voigt's notation.
MandelMatrix read_anisotropic(const ConfigValue& value);

/// { first = [1, 1, 0], second = [0, 0, 1] }, whose components may be expressions { expr = "x" } of the place.
MaterialAxes read_axes(const ConfigValue& value);

}  // namespace pfdm
