#pragma once
// Acceleration of the staggered loop's damage increments: one secant factor for the whole field (Aitken's in vector
// form: Irons, Tuck, IJNME 1 (1969) 275), and half the increment in cells whose increment changes sign.

#include "mesh/fields.h"

namespace pfdm {

class Relaxation {
 public:
  /// The damage to go on from, given the present one and what the damage equation answers to it; bounded by `lower`
  /// and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

 private:
  CellField<double> increment_;  // the one before
  double factor_ = 1.0;
};

}  // namespace pfdm
