#include "mesh/surfaces/surface_checks.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>
#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "mesh/search/point_bounds.h"
#include "mesh/surfaces/cgal_surface.h"
#include "physics/error.h"

namespace pfdm {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

void check_alone(const NamedSurface& named) {
  CgalMesh mesh;
  append(mesh, named);
  if (mesh.number_of_faces() == 0) throw InputError(fmt::format("the surface of {} has no triangles", named.name));
  if (!CGAL::is_closed(mesh)) throw InputError(fmt::format("the surface of {} is not closed", named.name));
  const auto piece = mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:piece").first;
  if (const std::size_t n = PMP::connected_components(mesh, piece); n != 1)
    throw InputError(fmt::format("the surface of {} has {} separate pieces; it may have one", named.name, n));
  if (!PMP::is_outward_oriented(mesh))
    throw InputError(fmt::format("the surface of {} is inside out: its triangles run clockwise", named.name));
}

// Faces are numbered through all surfaces in turn.
const std::string& surface_of_face(const std::vector<NamedSurface>& surfaces, std::size_t face) {
  std::size_t s = 0;
  while (face >= surfaces[s].surface.triangles.size()) face -= surfaces[s++].surface.triangles.size();
  return surfaces[s].name;
}

}  // namespace

void append(CgalMesh& mesh, const NamedSurface& named) {
  std::vector<CgalMesh::Vertex_index> vertices;
  for (const Vector& x : named.surface.points) vertices.push_back(mesh.add_vertex({x[0], x[1], x[2]}));
  const auto vertex = [&](Index i) { return vertices.at(i); };
  for (const Triangle& t : named.surface.triangles)
    if (mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == CgalMesh::null_face())
      throw InputError(
          fmt::format("the surface of {} is not an orientable manifold: the triangle on its points {}, {} and {} "
                      "cannot be joined to the others in one sense of rotation",
                      named.name, t[0], t[1], t[2]));
}

void check_surfaces(const std::vector<NamedSurface>& surfaces) {
  CgalMesh all;
  for (const NamedSurface& named : surfaces) {
    require_bounded(named.surface.points, fmt::format("the surface of {}", named.name));
    check_alone(named);
    append(all, named);
  }
  if (!PMP::does_self_intersect(all)) return;
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> crossings;
  PMP::self_intersections(all, std::back_inserter(crossings));
  const auto& [a, b] = crossings.at(0);
  throw InputError(fmt::format("the surfaces of {} and {} intersect in {} pairs of triangles",
                               surface_of_face(surfaces, a), surface_of_face(surfaces, b), crossings.size()));
}

}  // namespace pfdm
