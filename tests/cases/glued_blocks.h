#pragma once
// A case of two blocks that an interface joins.

#include "tests/cases/temporary_case.h"

#include <fmt/format.h>

#include <string>

namespace pfdm {

inline constexpr double strength = 2e6, toughness = 100.0;  // [Pa], [J/m^2]

// Two blocks of 1 mm in tension along x, glued at x = 1 mm.
inline std::string glued_blocks(const std::string& interface) {
  return fmt::format(R"(kind = "fracture"
title = "two blocks"
[mesh]
generator = "box_hexes"
x = [{{ length = "2 mm", cells = 8 }}]
y = [{{ length = "1 mm", cells = 2 }}]
z = [{{ length = "1 mm", cells = 2 }}]
region = "left"
[[mesh.regions]]
name = "right"
lower = ["1 mm", "-1 mm", "-1 mm"]
upper = ["3 mm", "2 mm", "2 mm"]
[materials.stone]
regions = ["left", "right"]
young_modulus = "1 GPa"
poisson_ratio = 0.0
damageable = false
[[boundary]]
patch = "xmin"
displacement = ["0 mm", "0 mm", "0 mm"]
[[boundary]]
patch = "xmax"
displacement = ["0.12 mm", "0 mm", "0 mm"]
[loading]
initial_increment = 0.1
maximum_increment = 0.1
[fracture]
split = "none"
[output]
curve = {{ patch = "xmax", component = "x" }}
frames_every = 5
[[interface]]
{})",
                     interface);
}

inline const std::string linear_glue =
    "between = [\"left\", \"right\"]\nlaw = \"linear\"\nstrength = \"2 MPa\"\ntoughness = \"100 J/m^2\"\n";

}  // namespace pfdm
