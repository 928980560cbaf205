#pragma once
// A small case of kind "plate".

#include "postproc/fits/fit_json.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace pfdm {

inline std::string small_plate() {
  return R"(kind = "plate"
title = "a small plate"
mesh.generator = "box_hexes"
mesh.x = [{ length = "10 cm", cells = 20 }]
mesh.y = [{ length = "8 cm", cells = 16 }]
mesh.z = [{ length = "8 mm", cells = 6 }]

[material]
density = "1200 kg/m^3"
young_modulus = "20 MPa"
loss_factor = 0.2
poisson_ratio = 0.3
conductivity = "50 W/m/K"
specific_heat = "1600 J/kg/K"

[[support]]
patches = ["xmin", "xmax"]
type = "clamped"

[base]
motion = "harmonic"
level = "2 g0"

[response]
from = "20 Hz"
to = "400 Hz"
frequencies = 120
modes = 3

[[response.points]]
name = "centre"
at = ["5 cm", "4 cm", "8 mm"]

[heating]
duration = "60 min"
step = "60 s"
surface = "zmax"
)";
}

inline nlohmann::json summary_of(const TemporaryCase& directory) {
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(content_of(directory.results() / "summary.json"));
}

}  // namespace pfdm
