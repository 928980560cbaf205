#pragma once
// A stress that is linear in the strain, with an initial stress: how the history of a material looks to one solve.

#include "physics/elasticity/mandel.h"

namespace pfdm {

/// sigma = C eps + initial [Pa]; C need not be symmetric.
struct LinearStress {
  MandelMatrix C = MandelMatrix::Zero();
  Mandel initial = Mandel::Zero();

  Mandel operator()(const Mandel& strain) const { return C * strain + initial; }
};

}  // namespace pfdm
