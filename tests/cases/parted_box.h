#pragma once
// A box that a plane parts in two halves, and its curve.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <string>

namespace pfdm {

inline constexpr double E = 50e6, ft = 1e5, Gc = 10.0, K = 1e11, length = 1e-3;

/// A box of one millimetre that a plane parts in two halves.
inline std::string parted_box() {
  return R"(kind = "homogenize"
title = "two halves"
[mesh]
generator = "box_hexes"
x = [{ length = "1 mm", cells = 2 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 4 }]
[materials.rubber]
regions = ["body"]
young_modulus = "50 MPa"
poisson_ratio = 0.4
[[interface]]
name = "bond"
plane = { point = ["0 mm", "0 mm", "0.5 mm"], normal = [0, 0, 1] }
law = "linear"
strength = "0.1 MPa"
toughness = "10 J/m^2"
stiffness = "1e11 Pa/m"
[homogenization]
boundary = "periodic"
path = [{ strain_zz = "15 %" }, { strain_zz = 0.05 }]
[loading]
initial_increment = 0.1
maximum_increment = 0.1
[solver]
equilibrium_tolerance = 1e-10
)";
}

/// The stress at an opening of the plane that has never been wider.
inline double traction(double opening) {
  const double peak = ft / K, end = 2.0 * Gc / ft;
  return opening <= peak ? K * opening : ft * (end - opening) / (end - peak);
}

/// The stress at a strain that grows, by bisection of strain = traction / E + opening / length.
inline double stress_at(double strain) {
  double low = 0.0, high = 2.0 * Gc / ft;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (traction(middle) / E + middle / length < strain ? low : high) = middle;
  }
  return traction(low);
}

inline CsvTable curve_of(const TemporaryCase& directory) { return read_csv(directory.results() / "stress_strain.csv"); }

}  // namespace pfdm
