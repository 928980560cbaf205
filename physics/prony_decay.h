#pragma once
// A Maxwell branch over a step in which its strain, or separation, changes linearly: exact (Simo, Hughes, Computational
// Inelasticity, 1998, sec. 10.3).

namespace pfdm {

/// Remainder of a branch at the end of a step of the length x = dt/tau.
struct PronyDecay {
  double left = 1.0;    ///< exp(-x), of what its spring had
  double phi = 1.0;     ///< (1 - exp(-x))/x, of the change of strain
  double second = 0.5;  ///< (1 - phi)/x, of the change in the mean over the step

  /// What the spring has at the end of a step in which the strain changes by `change`, with `before` at its start.
  template <class Value>
  Value after(const Value& before, const Value& change) const {
    return left * before + phi * change;
  }
  /// The part of what the spring has at the end of a step that does not depend on the strain there.
  template <class Value>
  Value remainder(const Value& spring, const Value& strain) const {
    return spring - phi * strain;
  }
  /// The same by the spring and the strain at the start of the step.
  template <class Value>
  Value remainder_after(const Value& spring, const Value& strain) const {
    return left * spring - phi * strain;
  }
};
PronyDecay decay_over(double x);

/// Mean over such a step of q:q, q what the spring has, by its start q_n and its end: start q_n:q_n + cross q_n:q + end
/// q:q.
struct PronySquare {
  double start = 1.0 / 3.0, cross = 1.0 / 3.0, end = 1.0 / 3.0;
};
PronySquare square_over(double x);

}  // namespace pfdm
