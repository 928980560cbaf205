#pragma once
// The barycentric dual of a mesh of tetrahedra, wedges and pyramids: a polyhedron for each vertex instead of a cell for
// each tetrahedron, a polygonal prism for each vertex of a layer of wedges.
//
// Every primal cell is cut into tetrahedra between a vertex, the middle of an edge there, the mean point of a face
// there and the mean point of the cell; a dual cell is what lies around one vertex in one region. Regions keep their
// volumes and patches their areas, curved or not: the halves of a vertex on the face of two regions share one face,
// the dome of triangles about the vertex. A stack of n wedges becomes n + 1 cells, the first and the last half as
// thick.

#include "mesh/mesh.h"

namespace pfdm {

/// All cells are polyhedra, whatever number of faces they have. A face for each edge within a region, about the edge's
/// middle; one for each vertex and patch, or vertex and pair of regions, about the vertex, or several where the surface
/// has a sharp edge (more than 45 degrees). Patches and regions keep their names; the same mesh gives the same dual.
/// Throws InputError if the mesh has cells of another shape.
Mesh barycentric_dual(const Mesh& primal);

}  // namespace pfdm
