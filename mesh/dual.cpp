#include "mesh/dual.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/cell_edges.h"
#include "mesh/cell_faces.h"
#include "mesh/disjoint_sets.h"
#include "mesh/geometry.h"
#include "physics/error.h"

namespace pfdm {
namespace {

constexpr double smooth_cosine = 0.7071;  // of the angle between normals: a sharper edge parts dual faces

// What a primal cell has at one of its edges.
struct EdgeInCell {
  Index edge, cell;
  std::array<Index, 2> faces;
};

// What a primal face on a patch or between regions has at one of its vertices; seen from outside the inner dual cell it
// reaches counter-clockwise from one edge at the vertex to another.
struct Sector {
  Index vertex;
  Index inside, outside;  // dual cells; outside is -1 on the boundary
  Index patch;            // -1 between regions
  Index face;
  Index from_edge, to_edge;
  Vector normal;  // unit, outwards

  auto key() const { return std::tie(vertex, inside, outside, patch); }
};

class DualBuilder {
 public:
  explicit DualBuilder(const Mesh& primal) : primal_(primal) {
    soup_.region_names = primal.region_names;
    for (const Patch& patch : primal.patches) table_.patch_names.push_back(patch.name);
  }

  Mesh build() {
    number_dual_cells();
    find_edges();
    place_points();
    add_faces_of_edges();
    add_faces_of_vertices();
    add_cells();
    return assemble_from_faces(std::move(soup_), table_);
  }

 private:
  bool is_within_region(Index face) const {
    return primal_.is_interior(face) && primal_.region[primal_.owner[face]] == primal_.region[primal_.neighbour[face]];
  }

  std::size_t corner(Index cell, Index point) const {
    const auto points = primal_.points_of_cell(cell);
    return as_size(primal_.cell_offsets[cell]) +
           static_cast<std::size_t>(std::find(points.begin(), points.end(), point) - points.begin());
  }
  Index dual_cell(Index cell, Index point) const { return dual_of_corner_[corner(cell, point)]; }

  // A dual cell is a set of corners of primal cells that are connected through faces within the region.
  void number_dual_cells() {
    DisjointSets corners(primal_.cell_points.size());
    for (Index f = 0; f < primal_.n_interior_faces(); ++f) {
      if (!is_within_region(f)) continue;
      for (const Index p : primal_.points_of_face(f))
        corners.join(corner(primal_.owner[f], p), corner(primal_.neighbour[f], p));
    }
    dual_of_corner_.resize(primal_.cell_points.size());
    for (Index c = 0; c < primal_.n_cells(); ++c)
      for (std::size_t i = primal_.cell_offsets[c]; i < as_size(primal_.cell_offsets[c + 1]); ++i) {
        const std::size_t least = corners.least_with(i);
        if (least == i) {
          dual_of_corner_[i] = count_of(region_of_dual_);
          region_of_dual_.push_back(primal_.region[c]);
        } else {
          dual_of_corner_[i] = dual_of_corner_[least];
        }
      }
  }

  void find_edges() {
    std::vector<CellEdge> of_cell;
    std::vector<std::pair<std::array<Index, 2>, EdgeInCell>> all;
    for (Index c = 0; c < primal_.n_cells(); ++c) {
      list_edges(primal_, c, of_cell);
      for (const CellEdge& e : of_cell) all.push_back({{e.low, e.high}, {-1, c, e.faces}});
    }
    std::ranges::sort(all, [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second.cell) < std::tie(b.first, b.second.cell);
    });
    for (const auto& [points, in_cell] : all) {
      if (edges_.empty() || edges_.back() != points) edges_.push_back(points);
      at_edges_.push_back({count_of(edges_) - 1, in_cell.cell, in_cell.faces});
    }
  }

  Index edge_between(Index p, Index q) const {
    const std::array<Index, 2> points{std::min(p, q), std::max(p, q)};
    return static_cast<Index>(std::ranges::lower_bound(edges_, points) - edges_.begin());
  }

  Vector mean(std::span<const Index> points) const {
    Vector sum = Vector::Zero();
    for (const Index p : points) sum += primal_.points[p];
    return sum / static_cast<double>(points.size());
  }

  // Vertices, middles of edges, of faces and of cells, in this order.
  Index n_vertices() const { return count_of(primal_.points); }
  Index n_edges() const { return count_of(edges_); }
  Index middle_of_edge(Index edge) const { return n_vertices() + edge; }
  Index middle_of_face(Index face) const { return n_vertices() + n_edges() + face; }
  Index middle_of_cell(Index cell) const { return n_vertices() + n_edges() + primal_.n_faces() + cell; }

  void place_points() {
    soup_.points = primal_.points;
    for (const auto& edge : edges_) soup_.points.push_back(mean(edge));
    for (Index f = 0; f < primal_.n_faces(); ++f) soup_.points.push_back(mean(primal_.points_of_face(f)));
    for (Index c = 0; c < primal_.n_cells(); ++c) soup_.points.push_back(mean(primal_.points_of_cell(c)));
  }

  // `loop` is counter-clockwise when seen from outside the dual cell `inside`.
  void add_face(std::vector<Index>& loop, Index inside, Index outside, Index patch, Index apex) {
    const Index half = table_.halves.size();
    table_.halves.add(inside, loop);
    if (outside >= 0) {
      std::ranges::reverse(loop);
      table_.halves.add(outside, loop);
    }
    table_.pairs.push_back({half, outside >= 0 ? half + 1 : -1});
    table_.patch.push_back(patch);
    table_.apex.push_back(apex);
  }

  void add_faces_of_edges() {
    for (std::size_t begin = 0, end = 0; begin < at_edges_.size(); begin = end) {
      while (end < at_edges_.size() && at_edges_[end].edge == at_edges_[begin].edge) ++end;
      add_faces_of_edge(std::span(at_edges_).subspan(begin, end - begin));
    }
  }

  // The cells around the edge in chains, each within one region: from one of its surfaces to another, or all around.
  void add_faces_of_edge(std::span<const EdgeInCell> around) {
    std::vector<char> done(around.size(), 0);
    const auto is_start = [&](const EdgeInCell& at, bool of_any) {
      return of_any || !is_within_region(at.faces[0]) || !is_within_region(at.faces[1]);
    };
    for (const bool of_any : {false, true})
      for (std::size_t i = 0; i < around.size(); ++i)
        if (done[i] == 0 && is_start(around[i], of_any)) add_face_of_chain(around, i, done);
  }

  void add_face_of_chain(std::span<const EdgeInCell> around, std::size_t start, std::vector<char>& done) {
    const Index edge = around[start].edge;
    Index face = around[start].faces[is_within_region(around[start].faces[0]) ? 1 : 0];
    std::vector<Index> loop;
    if (!is_within_region(face)) loop.push_back(middle_of_edge(edge));
    for (std::size_t i = start; i < around.size() && done[i] == 0;) {
      const auto& [e, cell, faces] = around[i];
      done[i] = 1;
      loop.push_back(middle_of_face(face));
      loop.push_back(middle_of_cell(cell));
      face = faces[0] == face ? faces[1] : faces[0];
      if (!is_within_region(face)) {
        loop.push_back(middle_of_face(face));
        break;
      }
      const Index next = primal_.across(face, cell);
      i = static_cast<std::size_t>(std::ranges::find(around, next, &EdgeInCell::cell) - around.begin());
    }
    const auto [low, high] = edges_[edge];
    if (doubled_fan_area(soup_.points, loop, middle_of_edge(edge)).dot(soup_.points[high] - soup_.points[low]) < 0.0)
      std::ranges::reverse(loop);
    const Index cell = around[start].cell;
    add_face(loop, dual_cell(cell, low), dual_cell(cell, high), -1, middle_of_edge(edge));
  }

  void add_faces_of_vertices() {
    std::vector<Sector> sectors;
    for (Index f = 0; f < primal_.n_interior_faces(); ++f)
      if (!is_within_region(f)) list_sectors(f, -1, sectors);
    for (std::size_t p = 0; p < primal_.patches.size(); ++p)
      for (Index k = 0; k < primal_.patches[p].n_faces; ++k)
        list_sectors(primal_.patches[p].first_face + k, static_cast<Index>(p), sectors);
    std::ranges::stable_sort(sectors, [](const Sector& a, const Sector& b) { return a.key() < b.key(); });
    for (std::size_t begin = 0, end = 0; begin < sectors.size(); begin = end) {
      while (end < sectors.size() && sectors[end].key() == sectors[begin].key()) ++end;
      add_faces_of_vertex(std::span(sectors).subspan(begin, end - begin));
    }
  }

  void list_sectors(Index face, Index patch, std::vector<Sector>& sectors) const {
    const auto points = primal_.points_of_face(face);
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Index v = points[i];
      Sector s{.vertex = v,
               .inside = dual_cell(primal_.owner[face], v),
               .outside = patch < 0 ? dual_cell(primal_.neighbour[face], v) : -1,
               .patch = patch,
               .face = face,
               .from_edge = edge_between(v, points[(i + 1) % n]),
               .to_edge = edge_between(v, points[(i + n - 1) % n]),
               .normal = primal_.face_area[face].normalized()};
      if (patch < 0 && s.inside > s.outside) {
        std::swap(s.inside, s.outside);
        std::swap(s.from_edge, s.to_edge);
        s.normal = -s.normal;
      }
      sectors.push_back(s);
    }
  }

  static bool joins(const Sector& a, const Sector& b) {
    return a.to_edge == b.from_edge && a.normal.dot(b.normal) > smooth_cosine;
  }

  // Sectors between the same two cells in chains, open or closed, that no sharp edge parts.
  void add_faces_of_vertex(std::span<const Sector> sectors) {
    std::vector<char> done(sectors.size(), 0);
    const auto has_earlier = [&](const Sector& s) {
      return std::ranges::any_of(sectors, [&](const Sector& other) { return joins(other, s); });
    };
    for (const bool of_ring : {false, true})
      for (std::size_t i = 0; i < sectors.size(); ++i)
        if (done[i] == 0 && (of_ring || !has_earlier(sectors[i]))) add_face_of_sectors(sectors, i, done);
  }

  void add_face_of_sectors(std::span<const Sector> sectors, std::size_t start, std::vector<char>& done) {
    const Sector& first = sectors[start];
    std::vector<Index> loop;
    std::size_t i = start;
    bool closed = false;
    while (i < sectors.size() && done[i] == 0) {
      const Sector& s = sectors[i];
      done[i] = 1;
      loop.push_back(middle_of_edge(s.from_edge));
      loop.push_back(middle_of_face(s.face));
      i = static_cast<std::size_t>(std::ranges::find_if(sectors, [&](const Sector& next) { return joins(s, next); }) -
                                   sectors.begin());
      closed = i == start;
      if (i == sectors.size()) loop.push_back(middle_of_edge(s.to_edge));
    }
    if (!closed) loop.push_back(first.vertex);
    add_face(loop, first.inside, first.outside, first.patch, first.vertex);
  }

  void add_cells() {
    std::vector<std::vector<Index>> points(region_of_dual_.size());
    for (Index h = 0; h < table_.halves.size(); ++h) {
      const auto of_face = table_.halves.points_of(h);
      auto& of_cell = points[table_.halves.cell[h]];
      of_cell.insert(of_cell.end(), of_face.begin(), of_face.end());
    }
    for (std::size_t c = 0; c < points.size(); ++c) {
      std::ranges::sort(points[c]);
      points[c].erase(std::unique(points[c].begin(), points[c].end()), points[c].end());
      soup_.add_cell(CellShape::polyhedron, points[c], region_of_dual_[c]);
    }
  }

  const Mesh& primal_;
  std::vector<Index> dual_of_corner_;        // per entry of the primal's cell_points
  std::vector<Index> region_of_dual_;        // per dual cell
  std::vector<std::array<Index, 2>> edges_;  // points, the lower first; in ascending order
  std::vector<EdgeInCell> at_edges_;         // by edge, then cell
  CellSoup soup_;
  FaceTable table_;
};

void require_simple_cells(const Mesh& mesh) {
  const auto n = std::ranges::count_if(
      mesh.shape, [](CellShape shape) { return shape == CellShape::hexahedron || shape == CellShape::polyhedron; });
  if (n > 0)
    throw InputError(
        fmt::format("polyhedra are made of tetrahedra, wedges and pyramids; {} of the mesh's {} cells are hexahedra or "
                    "polyhedra already",
                    n, mesh.n_cells()));
}

}  // namespace

Mesh barycentric_dual(const Mesh& primal) {
  require_simple_cells(primal);
  return DualBuilder(primal).build();
}

}  // namespace pfdm
