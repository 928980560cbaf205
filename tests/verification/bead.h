#pragma once
// A glass sphere of radius 1 m in Sylgard with a weak band in its prism layers, pulled at the top of its cube: scaled
// so that it debonds as the bead of 100 um does.

#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <map>
#include <string>

namespace pfdm::verification {

/// AT2, ell = 0.2 m; the top moves by `elongation` [m] at the load 1; nu is that of the Sylgard.
inline FractureModel bead_model(const Mesh& mesh, const std::string& split, double elongation, double nu = 0.44) {
  const std::map<std::string, double> toughness{{"bead", 1e7}, {"interface", 1e5}, {"matrix", 1e6}};  // [J/m^2]
  const IsotropicElasticity glass = from_young_poisson(70e9, 0.3), sylgard = from_young_poisson(75e6, nu);
  FractureModel model;
  for (const std::string& name : mesh.region_names)
    model.regions.push_back({.elasticity = name == "bead" ? glass : sylgard, .Gc = toughness.at(name), .ell = 0.2});
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split(split);
  BoundaryCondition pulled{.patch = "zmax", .displacement_prescribed = {false, false, true}, .value = {}};
  pulled.value = [elongation](const Vector&, double t) { return Vector(0.0, 0.0, elongation * t); };
  model.boundary = {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }), pulled};
  return model;
}

}  // namespace pfdm::verification
