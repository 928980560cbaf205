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

// q = q_n + w (q - q_n), w = (1 - exp(-x theta))/(1 - exp(-x)) at the part theta of the step.
PronySquare square_over(double x) {
  if (x < 1e-2) {  // to rounding
    const double even = x * x / 180.0 * (1.0 - x * x / 28.0), odd = x / 12.0 * (1.0 - x * x / 60.0);
    return {1.0 / 3.0 - odd + even, 1.0 / 3.0 - 2.0 * even, 1.0 / 3.0 + odd + even};
  }
  const double left = portable::exp(-x), lost = 1.0 - left, phi = lost / x;
  const double square = lost * lost, of_square = 0.5 * phi * (1.0 + left);
  return {(of_square - 2.0 * left * phi + left * left) / square, 2.0 * (phi - left + left * phi - of_square) / square,
          (1.0 - 2.0 * phi + of_square) / square};
}

}  // namespace pfdm
