#pragma once
// A stress that is a function of the strain of first degree, as the momentum balance takes it: energy splits without
// isotropic secant moduli.

#include "physics/elasticity/mandel.h"

#include <functional>

namespace pfdm {

struct StrainLaw {
  /// C = d sigma / d eps [Pa] of a cell at a strain, symmetric; sigma = C eps.
  std::function<MandelMatrix(Index cell, const Tensor& strain)> tangent;
  /// The part of the stress [Pa] that damage degrades, before it does; zero where nothing is degraded.
  std::function<Tensor(Index cell, const Tensor& strain)> degradable;

  explicit operator bool() const { return static_cast<bool>(tangent); }
};

}  // namespace pfdm
