#pragma once
// A box of hexahedra, graded along each axis, with named regions cut out of it: bars, plates, notched specimens.

#include <array>
#include <string>
#include <vector>

#include "mesh/generators/axis_blocks.h"
#include "mesh/mesh.h"

namespace pfdm {

/// Cells whose centre lies in the box between two corners [m].
struct SubRegion {
  std::string name;
  Vector lower = Vector::Zero();
  Vector upper = Vector::Zero();
};

/// A cut: a rectangle in a plane of the grid, between two corners [m] that agree along one axis, and whose edges lie on
/// lines of the grid or outside of the box. Both its faces are the patch of its name; along its edges within the box,
/// the crack front, the body holds together.
struct Slit {
  std::string name;
  Vector lower = Vector::Zero();
  Vector upper = Vector::Zero();
};

/// Faces of the surface whose centre lies in the box between two corners [m]: part of a side, as a support.
struct SurfacePart {
  std::string name;
  Vector lower = Vector::Zero();
  Vector upper = Vector::Zero();
};

struct BoxHexesSettings {
  Vector origin = Vector::Zero();              ///< lower corner [m]
  std::array<std::vector<AxisBlock>, 3> axes;  ///< along x, y, z; each block begins where the one before it ends
  std::vector<SubRegion> regions;              ///< where they overlap, the later one wins
  std::string base_region = "body";            ///< all that no sub-region takes
  std::vector<Slit> slits;                     ///< which do not meet each other
  /// Cells that are left out, as a notch or the corner of an L; the surface that appears is the patch of its name.
  std::vector<SubRegion> holes{};
  std::vector<SurfacePart> patches{};  ///< before all others; where they overlap, the earlier one wins
  std::array<std::string, 6> sides{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};  ///< their patches' names
};

/// Patches are the sides' (as far as anything is left of them), the slits', the holes' and those
/// asked for; region_names holds base_region (if any cell is left in it) and the sub-regions, each name once. Throws
/// InputError for a block that is not positive, a region or hole with no cell, a patch with no face, and a slit that is
/// not plane, not on the grid, on the box's surface, too narrow to open or that meets another.
Mesh make_box_hexes(const BoxHexesSettings& settings);

}  // namespace pfdm
