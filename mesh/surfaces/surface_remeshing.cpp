#include "mesh/surfaces/surface_remeshing.h"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/exceptions.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "mesh/surfaces/cgal_surface.h"
#include "mesh/surfaces/sphere_refinement.h"
#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"
#include "physics/system/packed_bytes.h"
#include "physics/system/separate_process.h"

namespace pfdm {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr int n_passes = 10;
constexpr int n_relaxations = 3;  // of each pass

TriangleSurface triangle_surface(CgalMesh& mesh) {
  mesh.collect_garbage();
  TriangleSurface surface;
  for (const CgalMesh::Vertex_index v : mesh.vertices()) {
    const CgalMesh::Point& x = mesh.point(v);
    surface.points.emplace_back(x.x(), x.y(), x.z());
  }
  for (const CgalMesh::Face_index f : mesh.faces()) {
    Triangle triangle{};
    auto corner = triangle.begin();
    for (const CgalMesh::Vertex_index v : vertices_around_face(mesh.halfedge(f), mesh))
      *corner++ = static_cast<Index>(v.idx());
    surface.triangles.push_back(triangle);
  }
  return surface;
}

TriangleSurface remeshed_by_cgal(const NamedSurface& given, double size, double sharp) {
  CgalMesh mesh;
  append(mesh, given);
  require_few_triangles(given.name, PMP::area(mesh), size);
  const auto kept = mesh.add_property_map<CgalMesh::Edge_index, bool>("e:kept", false).first;
  PMP::detect_sharp_edges(mesh, sharp * 180.0 / std::numbers::pi, kept);
  std::vector<CgalMesh::Edge_index> sharp_edges;
  for (const CgalMesh::Edge_index e : mesh.edges())
    if (kept[e]) sharp_edges.push_back(e);
  PMP::split_long_edges(sharp_edges, size, mesh, CGAL::parameters::edge_is_constrained_map(kept));
  PMP::isotropic_remeshing(mesh.faces(), size, mesh,
                           CGAL::parameters::number_of_iterations(n_passes)
                               .number_of_relaxation_steps(n_relaxations)
                               .edge_is_constrained_map(kept)
                               .protect_constraints(true));
  return triangle_surface(mesh);
}

std::string bytes_of(const TriangleSurface& surface) {
  BytePacker packer;
  packer.put(surface.points);
  packer.put(surface.triangles);
  return packer.take();
}

TriangleSurface surface_in(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  TriangleSurface surface;
  unpacker.take(surface.points);
  unpacker.take(surface.triangles);
  return surface;
}

}  // namespace

TriangleSurface remeshed(const NamedSurface& given, double size, double sharp) {
  check_surfaces({given});
  const auto too_bad = [&] {
    return InputError(
        fmt::format("the surface {}: CGAL crashes where it divides it into triangles of {}: give a smaller "
                    "surface_size, or repair flat and needle-shaped triangles of the file",
                    given.name, quantity_text(size, "m", 6)));
  };
  const auto bytes = computed_separately([&] {
    try {
      return bytes_of(remeshed_by_cgal(given, size, sharp));
    } catch (const CGAL::Failure_exception&) {  // what would crash, where CGAL's assertions are compiled
      throw too_bad();
    }
  });
  if (!bytes) throw too_bad();
  return surface_in(*bytes);
}

TriangleSurface remeshed_body(const NamedSurface& given, double size, double sharp) {
  constexpr double least = 0.7;
  TriangleSurface surface = remeshed(given, size, sharp);
  const double volume = enclosed_volume(given.surface), kept = enclosed_volume(surface) / volume;
  if (!(kept >= least))
    throw InputError(
        fmt::format("the surface {}: triangles of {} leave {:.2g} of its volume, that of a sphere of diameter {}; at "
                    "least {:g} is required: give a smaller surface_size",
                    given.name, quantity_text(size, "m", 6), kept,
                    quantity_text(portable::cbrt(6.0 / std::numbers::pi * volume), "m", 3), least));
  return surface;
}

}  // namespace pfdm
