#pragma once
// A cantilever of 25 x 1.5 mm, its loads, its cells and its deflection as a beam.

#include "tests/verification/support.h"

#include <cmath>
#include <vector>

namespace pfdm::verification::cantilever {

inline constexpr double mm = 1e-3, E = 70e9, span = 25.0 * mm, height = 1.5 * mm, width = 1.0 * mm;
inline const double section = std::pow(height, 3) / 12.0;

enum class Load { tip, moment, distributed };

struct Beam {
  Index along = 0, across = 0;
  double nu = 0.3;
  bool plane_stress = false;
  Load load = Load::tip;
};

inline double timoshenko(const Beam& beam) {
  const double bending = (beam.plane_stress ? E : E / (1.0 - beam.nu * beam.nu)) * section;
  const double shear = 5.0 / 6.0 * E / (2.0 + 2.0 * beam.nu) * height;
  if (beam.load == Load::tip) return std::pow(span, 3) / (3.0 * bending) + span / shear;
  if (beam.load == Load::moment) return -std::pow(span, 2) / (2.0 * bending);
  return std::pow(span, 3) / (8.0 * bending) + span / (2.0 * shear);
}

inline std::vector<BoundaryCondition> clamped_at_x0(bool plane_stress) {
  const auto side = plane_stress ? plane_stress_on : plane_on;
  return {side("zmin"), side("zmax"), displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); })};
}

/// A load of unit resultant per width.
inline BoundaryCondition traction_of(Load load) {
  if (load == Load::tip) return traction_on("xmax", [](const Vector&) -> Vector { return Vector::UnitY() / height; });
  if (load == Load::distributed)
    return traction_on("ymax", [](const Vector&) -> Vector { return Vector::UnitY() / span; });
  return traction_on("xmax",
                     [](const Vector& x) -> Vector { return (x.y() - height / 2.0) / section * Vector::UnitX(); });
}

inline Mesh mesh_of(Index along, Index across) {
  BoxHexesSettings box;
  box.axes[0] = {{span, along, 1.0}};
  box.axes[1] = {{height, across, 1.0}};
  box.axes[2] = {{width, 1, 1.0}};
  return make_box_hexes(box);
}

inline Index along_with(double ratio, Index across) {
  return static_cast<Index>(std::lround(span * static_cast<double>(across) / (ratio * height)));
}

}  // namespace pfdm::verification::cantilever
