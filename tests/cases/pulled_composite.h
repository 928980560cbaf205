#pragma once
// Glass in a soft matrix: all of a case that follows its mesh.

#include <string>

namespace pfdm {

/// `glass`: the name of its region. Pulled along z in one step; the interface breaks at 0.1 MPa.
inline std::string pulled_composite(const std::string& glass) {
  return R"([materials.glass]
regions = [")" +
         glass + R"("]
young_modulus = "70 GPa"
poisson_ratio = 0.2
damageable = false
[materials.rubber]
regions = ["matrix"]
young_modulus = "1 MPa"
poisson_ratio = 0.3
damageable = false
[[interface]]
between = [")" +
         glass + R"(", "matrix"]
law = "linear"
strength = "0.1 MPa"
toughness = "10 J/m^2"
[[boundary]]
patch = "zmin"
displacement = ["0 mm", "0 mm", "0 mm"]
[[boundary]]
patch = "zmax"
displacement = ["0 mm", "0 mm", "10 um"]
[loading]
initial_increment = 1.0
maximum_increment = 1.0
[fracture]
split = "none"
[output]
curve = { patch = "zmax", component = "z" }
)";
}

}  // namespace pfdm
