#pragma once
// A sector of a cylinder about the axis z, one cell wide in azimuth: what is axisymmetric, at the cost of a plane
// problem. A grid in radius and height, rolled up: hexahedra, on the axis wedges. The upper end may be a sphere's, as
// that of a lens pressed on a disc.

#include <string>
#include <vector>

#include "mesh/generators/box_hexes.h"

namespace pfdm {

/// Between two corners in radius and height [m], before the upper end is curved.
struct SectorPart {
  std::string name;
  double inner_radius = 0.0, outer_radius = 0.0;
  double bottom = 0.0, top = 0.0;
};

struct CylinderSectorSettings {
  double azimuth = 0.0;       ///< width of the sector [rad], halved by the plane y = 0, x > 0; up to pi/4
  double inner_radius = 0.0;  ///< [m]; 0: a full cylinder
  double bottom = 0.0;        ///< z of the lower end [m]
  std::vector<AxisBlock> radius, height;
  std::string base_region = "body";   ///< all that no part takes
  std::vector<SectorPart> regions{};  ///< cells whose centre lies there; the later one wins
  std::vector<SectorPart> holes{};    ///< cells left out; the surface that appears is the patch of this name
  std::vector<SectorPart> slits{};    ///< cuts: inner and outer radius, or bottom and top agree
  std::vector<SectorPart> patches{};  ///< parts of the surface; the earlier one wins
  /// Radius [m] of the sphere that the upper end is part of: its centre is on the axis, above; heights are stretched
  /// from the axis outwards. 0: the end is plane.
  double upper_sphere = 0.0;
};

/// Patches: "front" and "back" (the planes of the sector, y < 0 and y > 0), "outer", "inner" (where there is an inner
/// radius), "bottom", "top", and those of holes, slits and parts. Throws InputError for settings out of range, and as
/// make_box_hexes does.
Mesh make_cylinder_sector(const CylinderSectorSettings& settings);

}  // namespace pfdm
