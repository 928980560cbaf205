#pragma once
// Anderson acceleration of a fixed-point iteration d = answer(d): the combination of the last iterates whose increments
// cancel best in the least-squares sense (Anderson, J. ACM 12 (1965) 547; Walker, Ni, SIAM J. Numer. Anal. 49 (2011)
// 1715). It converges to fixed points around which the plain iteration has a limit cycle.

#include "mesh/fields.h"

#include <deque>

#include <Eigen/Core>

namespace pfdm {

class AndersonMixing {
 public:
  /// The next iterate, given the present one and the answer to it; bounded by `lower` and 1.
  CellField<double> next(const CellField<double>& d, const CellField<double>& answer, const CellField<double>& lower);

 private:
  struct Iterate {
    Eigen::VectorXd d, increment;
  };
  std::deque<Iterate> iterates_;  // the oldest first
};

}  // namespace pfdm
