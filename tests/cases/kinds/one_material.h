#pragma once
// A case of kind "homogenize" whose answer is known.

#include <string>

namespace pfdm {

/// A block of one material: its own modulus is the effective one. `modulus`: a piece of TOML, as "\"10 MPa\"".
inline std::string one_material(const std::string& modulus) {
  return R"(kind = "homogenize"
title = "one material"
[mesh]
generator = "box_hexes"
x = [{ length = "1 mm", cells = 2 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 2 }]
region = "rubber"
[materials.rubber]
regions = ["rubber"]
young_modulus = )" +
         modulus + R"(
poisson_ratio = 0.4
loss_factor = 0.2
)";
}

}  // namespace pfdm
