#pragma once
// A Maxwell branch over a step in which its strain, or separation, changes linearly: exact (Simo, Hughes, Computational
// Inelasticity, 1998, sec. 10.3).

namespace pfdm {

/// Remainder of a branch at the end of a step of the length x = dt/tau.
struct PronyDecay {
  double left = 1.0;    ///< exp(-x), of what its spring had
  double phi = 1.0;     ///< (1 - exp(-x))/x, of the change of strain
  double second = 0.5;  ///< (1 - phi)/x, of the change in the mean over the step
};
PronyDecay decay_over(double x);

}  // namespace pfdm
