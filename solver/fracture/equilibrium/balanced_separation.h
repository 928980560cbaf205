#pragma once
// The separation at which a cohesive face is in balance with the cells beside it.

#include "physics/interfaces/interface_law.h"

#include <optional>

namespace pfdm {

/// The separation [m] with give T(separation) + separation = due, by damped Newton steps from `now`; none if they do
/// not lead there. T [Pa] is the law's traction about the normal n, `give` [m/Pa] the compliance beside the face;
/// `overstress` as of InterfaceLaw::respond().
std::optional<Vector> balanced_separation(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& n,
                                          const InterfaceHistory& before, const Tensor& give, const Vector& due,
                                          const Vector& now, double duration = 0.0,
                                          std::optional<double> overstress = {});

}  // namespace pfdm
