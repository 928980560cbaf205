#include "mesh/search/line_walk.h"

#include <algorithm>
#include <limits>

namespace pfdm {
namespace {

constexpr double along_face = 1e-12;  // cosine below which a face is parallel to the line
constexpr double negligible = 1e-9;   // part of the line's length

struct Exit {
  Index face = -1;
  double at = std::numeric_limits<double>::infinity();  // distance along the line [m]
};

Exit exit_of(const Mesh& mesh, Index cell, const Vector& point, const Vector& direction) {
  Exit exit;
  for (const Index f : mesh.faces_of_cell(cell)) {
    const Vector n = mesh.outward_area(f, cell).normalized();
    const double cosine = n.dot(direction);
    if (cosine <= along_face) continue;
    const double at = n.dot(mesh.face_centre[f] - point) / cosine;
    if (at < exit.at) exit = {f, at};
  }
  return exit;
}

}  // namespace

std::vector<LineSegment> walk_line(const Mesh& mesh, Index cell, const Vector& point, const Vector& direction,
                                   double length) {
  std::vector<LineSegment> segments;
  double at = 0.0;
  Index entry = -1;
  for (Index crossed = 0; crossed <= mesh.n_cells(); ++crossed) {
    const Exit exit = exit_of(mesh, cell, point, direction);
    const bool ends = exit.at >= length * (1.0 - negligible);
    const double end = ends ? length : std::max(at, exit.at);
    if (end - at > negligible * length)
      segments.push_back({.cell = cell,
                          .entry = entry,
                          .exit = exit.at > length * (1.0 + negligible) ? -1 : exit.face,
                          .begin = at,
                          .length = end - at});
    if (ends || !mesh.is_interior(exit.face)) break;
    at = end;
    entry = exit.face;
    cell = mesh.across(exit.face, cell);
  }
  return segments;
}

}  // namespace pfdm
