#pragma once
// Acceleration of the staggered loop's damage increments: one secant factor for the whole field (Aitken's in vector
// form: Irons, Tuck, IJNME 1 (1969) 275) times a share of each cell's own, which halves whenever the cell's increment
// changes sign and recovers while it does not: a few cells that would swing for ever neither go on nor hold up the
// rest.

#include "mesh/fields.h"

namespace pfdm {

class Relaxation {
 public:
  /// The damage to go on from, given the present one and what the damage equation answers to it; bounded by `lower`
  /// and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

 private:
  CellField<double> increment_;  // the one before
  CellField<double> share_;      // of its increment that each cell may take, at most 1
  double factor_ = 1.0;
};

}  // namespace pfdm
