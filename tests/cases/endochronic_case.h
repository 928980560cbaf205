#pragma once
// A small case of kind "endochronic".

#include <string>

namespace pfdm {

inline std::string tension_case() {
  return R"(kind = "endochronic"
title = "tension"

[material]
young_modulus = "117 GPa"
poisson_ratio = 0.34
kernel = [{ C = "30 GPa", alpha = 700 }]

[material.hardening]
law = "saturating"
f_inf = 2.0
b = 6.0

[material.rate]
law = "logarithmic"
c = 0.1
reference_rate = "1e-4 1/s"

[loading]
repeat = 2

[[loading.segments]]
duration = "1 s"
increments = 10
control = { strain_xx = "1 %", stress_yy = "10 MPa" }

[[loading.segments]]
duration = "2 s"
increments = 10
control = { gamma_xy = { expr = "0.01*t", unit = "1" }, stress_xx = { table = [["0 s", "0 MPa"], ["2 s", "1 MPa"]] } }
)";
}

}  // namespace pfdm
