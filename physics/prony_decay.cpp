#include "physics/prony_decay.h"

#include "physics/portable_math.h"

namespace pfdm {

PronyDecay decay_over(double x) {
  const double left = portable::exp(-x);
  if (x < 1e-2) {  // to rounding
    const double second = 0.5 - x / 6.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0 * (1.0 - x / 7.0))));
    return {left, 1.0 - x * second, second};
  }
  const double phi = (1.0 - left) / x;
  return {left, phi, (1.0 - phi) / x};
}

}  // namespace pfdm
