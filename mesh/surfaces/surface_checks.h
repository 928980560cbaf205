#pragma once
// Checks of triangulated surfaces before they bound a mesh (CGAL, Polygon Mesh Processing).

#include <string>

#include "mesh/surfaces/triangle_surface.h"

namespace pfdm {

struct NamedSurface {
  std::string name;
  TriangleSurface surface;
};

/// Every surface must be closed, in one piece, and look outwards, and no triangle may cross another, of its own surface
/// or of a different one. Throws InputError that names the surface and what is wrong with it.
void check_surfaces(const std::vector<NamedSurface>& surfaces);

}  // namespace pfdm
