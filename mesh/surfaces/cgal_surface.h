#pragma once
// Triangulated surfaces as CGAL has them: for the files here that call it.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "mesh/surfaces/surface_checks.h"

namespace pfdm {

using CgalMesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

/// Throws InputError, naming the surface, where it is not an orientable manifold.
void append(CgalMesh& mesh, const NamedSurface& named);

}  // namespace pfdm
