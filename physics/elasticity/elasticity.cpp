#include "physics/elasticity/elasticity.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

namespace pfdm {

IsotropicElasticity from_young_poisson(double E, double nu) {
  if (!(E > 0.0))
    throw InputError(fmt::format("Young's modulus is {}; it must be positive", quantity_text(E, "Pa", 6)));
  if (!(nu > -1.0 && nu < 0.5))
    throw InputError(fmt::format("Poisson's ratio is {}; it must lie between -1 and 0.5", nu));
  return {.lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), .mu = 0.5 * E / (1.0 + nu)};
}

}  // namespace pfdm
