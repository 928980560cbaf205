#pragma once
// A laminate of two layers as a case of kind "homogenize".

#include <string>

namespace pfdm {

/// Half a millimetre of each of two layers normal to z.
inline std::string laminate() {
  return R"(kind = "homogenize"
title = "two layers"
[mesh]
generator = "box_hexes"
x = [{ length = "1 mm", cells = 3 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 4 }]
region = "soft"
regions = [{ name = "stiff", lower = ["0 mm", "0 mm", "0.5 mm"], upper = ["1 mm", "1 mm", "1 mm"] }]
[materials.rubber]
regions = ["soft"]
young_modulus = "10 MPa"
poisson_ratio = 0.4
density = "1000 kg/m^3"
loss_factor = 0.2
[materials.steel]
regions = ["stiff"]
young_modulus = "200 GPa"
poisson_ratio = 0.3
density = "7800 kg/m^3"
[homogenization]
boundary = "periodic"
[solver]
tolerance = 1e-12
)";
}

}  // namespace pfdm
