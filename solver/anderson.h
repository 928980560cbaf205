#pragma once
// Anderson's mixing for a fixed point d = answer(d): of the last few iterates the combination whose increments cancel
// best (Anderson, J. ACM 12 (1965) 547; Walker, Ni, SIAM J. Numer. Anal. 49 (2011) 1715). It finds fixed points that
// plain iteration goes around for ever.

#include "mesh/fields.h"

#include <deque>

#include <Eigen/Dense>

namespace pfdm {

class AndersonMixing {
 public:
  /// The field to go on from, given the present one and the answer to it; bounded by `lower` and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

 private:
  struct Iterate {
    Eigen::VectorXd d, increment;
  };
  std::deque<Iterate> iterates_;  // the oldest first
};

}  // namespace pfdm
