#pragma once
// Models of a toughness of one.

#include "solver/fracture/model/fracture_model.h"

#include <string>

namespace pfdm::verification {

inline constexpr double Gc = 1.0;

inline FractureModel model_of(const std::string& law, double ell) {
  FractureModel model;
  model.regions = {{.elasticity = {}, .Gc = Gc, .ell = ell}};
  model.crack = &crack_geometry(law);
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  return model;
}

}  // namespace pfdm::verification
