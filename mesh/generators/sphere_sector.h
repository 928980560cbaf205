#pragma once
// A sector of concentric shells about the axis z, one cell wide in azimuth: what is axisymmetric about a sphere, at the
// cost of a plane problem. Cells lie on spherical coordinates: hexahedra, on the axis wedges, at the centre pyramids.
//
// The centre of a cell lies farther out than that of its sides, by h^2/(12 r) of a cell h long along the radius. Where
// that exceeds half of its width r dtheta the momentum balance loses its definiteness and is not solved: keep
// h/r <= sqrt(6 dtheta), which the cells at a centre do not.

#include <string>
#include <vector>

#include "mesh/generators/axis_blocks.h"
#include "mesh/mesh.h"

namespace pfdm {

struct Shell {
  AxisBlock radial;  ///< [m]
  std::string region;
};

struct SphereSectorSettings {
  double azimuth = 0.0;          ///< width of the sector [rad], halved by the plane y = 0, x > 0; up to pi/4
  double inner_radius = 0.0;     ///< [m]; 0: down to the centre
  std::vector<Shell> shells;     ///< from the inside to the outside; shells may share a region
  std::vector<AxisBlock> polar;  ///< angles from the axis z on [rad]; together pi/2 (half of the sphere) or pi
};

/// Patches: "front" and "back" (the planes of the sector, y < 0 and y > 0), "outer", "inner" (where there is an inner
/// radius) and "equator" (z = 0, of half a sphere). Throws InputError for settings out of range.
Mesh make_sphere_sector(const SphereSectorSettings& settings);

}  // namespace pfdm
