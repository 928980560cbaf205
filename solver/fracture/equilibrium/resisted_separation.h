#pragma once
// The separation at which a cohesive face whose traction grows with its rate is in balance with the cells beside it.
//
// With r = (v/v_0)^m, m < 1, the traction rises infinitely steeply where a face begins to move. A face at rest bears
// any traction between that of r = 0 and that at which it moves noticeably, at a separation that numbers do not tell
// from the one before. So the overstress r is the unknown, and the separation that of the rate v(r).

#include "physics/interfaces/interface_law.h"

#include <optional>

namespace pfdm {

struct ResistedSeparation {
  Vector separation;        // [m]
  double overstress = 0.0;  // r [-]
};

/// As balanced_separation() (balanced_separation.h), of a law with rate, in a step that takes `duration` > 0 [s].
std::optional<ResistedSeparation> resisted_separation(const InterfaceLaw& law, const InterfaceStrength& at,
                                                      const Vector& n, const InterfaceHistory& before,
                                                      const Tensor& give, const Vector& due, const Vector& now,
                                                      double duration);

}  // namespace pfdm
