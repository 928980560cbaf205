#pragma once
// Areas, volumes and centres of polygons and polyhedra. A face is the fan of triangles about its apex, which is the
// mean of its points unless the mesh names a point: both its cells see the same surface, so volumes add up and every
// cell closes, planar faces or not.

#include "mesh/mesh.h"

#include <span>
#include <vector>

namespace pfdm {

struct FaceGeometry {
  Vector area;    ///< area vector, sum of the triangles' [m^2]
  Vector centre;  ///< mean of the triangles' centroids weighted by their areas' parts along the normal [m]
};

FaceGeometry face_geometry(const std::vector<Vector>& points, std::span<const Index> face);

/// Twice the area vector of the fan of triangles between a closed line of points and the apex [m^2].
Vector doubled_fan_area(const std::vector<Vector>& points, std::span<const Index> loop, Index apex);

/// The middle of a face's fan of triangles [m].
Vector fan_middle(const Mesh& mesh, Index face);

/// Sum over a face's triangles of S_t (x) (x_t - x_f) [m^3], area vectors and centroids: zero where it is plane. A
/// displacement u_f + G (x - x_f) lets u_f.S + G : this through.
Tensor face_warp(const Mesh& mesh, Index face);

/// Sum over the faces of each patch of what each boundary face has, these numbered from 0, as forces [N].
std::vector<Vector> sums_by_patch(const Mesh& mesh, const std::vector<Vector>& of_boundary_faces);

/// Fills face_centre, face_area, cell_centre and cell_volume of a mesh whose tables are complete. Volumes and centroids
/// are sums over the tetrahedra between the face triangles and the mean of the cell's face centres: exact for planar
/// faces.
void compute_geometry(Mesh& mesh);

}  // namespace pfdm
