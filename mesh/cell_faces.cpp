#include "mesh/cell_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "physics/error.h"

namespace pfdm {
namespace {

// Faces in the local numbers of VTK's linear cells, counter-clockwise from outside, -1 where a triangle has no
// fourth point (vtkTetra, vtkWedge, vtkPyramid and vtkHexahedron; a wedge's triangle 0 1 2 looks outwards).
using LocalFace = std::array<Index, 4>;
constexpr std::array<LocalFace, 4> tetrahedron_faces{{{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}}};
constexpr std::array<LocalFace, 5> wedge_faces{
    {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}};
constexpr std::array<LocalFace, 5> pyramid_faces{
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
constexpr std::array<LocalFace, 6> hexahedron_faces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

std::span<const LocalFace> local_faces(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron: return tetrahedron_faces;
    case CellShape::wedge: return wedge_faces;
    case CellShape::pyramid: return pyramid_faces;
    case CellShape::hexahedron: return hexahedron_faces;
    case CellShape::polyhedron: break;
  }
  return {};
}

using Polygon = std::vector<Index>;

std::vector<Polygon> unpack_polyhedron(std::span<const Index> stream, Index cell, std::size_t n_points) {
  std::vector<Polygon> faces;
  const Index n_faces = stream.empty() ? 0 : stream[0];
  stream = stream.subspan(stream.empty() ? 0 : 1);
  for (Index f = 0; f < n_faces; ++f) {
    const Index n = stream.empty() ? 0 : stream[0];
    if (n < 3 || static_cast<std::size_t>(n) >= stream.size())
      throw InputError(
          fmt::format("polyhedron {} has a face of fewer than three points or a cut-off list of faces", cell));
    const auto face = stream.subspan(1, static_cast<std::size_t>(n));
    for (const Index p : face)
      if (p < 0 || static_cast<std::size_t>(p) >= n_points)
        throw InputError(fmt::format("polyhedron {} refers to point {}, which does not exist", cell, p));
    faces.emplace_back(face.begin(), face.end());
    stream = stream.subspan(face.size() + 1);
  }
  return faces;
}

struct DirectedEdge {
  Index low, high, face;
  bool forward;  // the face runs from low to high
};

// Pairs of entries, one for each edge of the polyhedron.
std::vector<DirectedEdge> edges_of(const std::vector<Polygon>& faces, Index cell) {
  std::vector<DirectedEdge> edges;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < faces[f].size(); ++i) {
      const Index a = faces[f][i];
      const Index b = faces[f][(i + 1) % faces[f].size()];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(f), a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  const auto same = [&](std::size_t i, std::size_t j) {
    return edges[i].low == edges[j].low && edges[i].high == edges[j].high;
  };
  for (std::size_t i = 0; i < edges.size(); i += 2)
    if (i + 1 == edges.size() || !same(i, i + 1) || (i + 2 < edges.size() && same(i, i + 2)))
      throw InputError(
          fmt::format("the faces of polyhedron {} do not close: the edge between points {} and {} does not "
                      "have exactly two faces",
                      cell, edges[i].low, edges[i].high));
  return edges;
}

double signed_volume(const std::vector<Polygon>& faces, const std::vector<Vector>& points) {
  const Vector& origin = points[faces[0][0]];
  double six_volumes = 0.0;
  for (const Polygon& face : faces) {
    Vector middle = Vector::Zero();
    for (const Index p : face) middle += points[p] - origin;
    middle /= static_cast<double>(face.size());
    for (std::size_t i = 0; i < face.size(); ++i)
      six_volumes += middle.dot((points[face[i]] - origin).cross(points[face[(i + 1) % face.size()]] - origin));
  }
  return six_volumes / 6.0;
}

// Writers disagree on the direction of a polyhedron's faces: neighbouring faces must run along their common edge in
// opposite directions, and the enclosed volume must be positive.
void orient_outwards(std::vector<Polygon>& faces, const std::vector<Vector>& points, Index cell) {
  const std::vector<DirectedEdge> edges = edges_of(faces, cell);
  std::vector<int> turn(faces.size(), 0);  // +1 keep, -1 reverse, 0 not reached
  if (!turn.empty()) turn[0] = 1;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i < edges.size(); i += 2) {
      int& a = turn[edges[i].face];
      int& b = turn[edges[i + 1].face];
      const int relation = edges[i].forward != edges[i + 1].forward ? 1 : -1;
      if ((a == 0) == (b == 0)) continue;
      (a == 0 ? a : b) = relation * (a == 0 ? b : a);
      moved = true;
    }
  }
  if (faces.size() < 4 || std::count(turn.begin(), turn.end(), 0) > 0)
    throw InputError(fmt::format("the faces of polyhedron {} are not one closed surface", cell));
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (turn[f] < 0) std::reverse(faces[f].begin(), faces[f].end());
  if (signed_volume(faces, points) < 0.0)
    for (Polygon& face : faces) std::reverse(face.begin(), face.end());
}

void add_standard_cell(HalfFaces& halves, Index cell, CellShape shape, std::span<const Index> points) {
  if (count_of(points) != points_per_cell(shape))
    throw InputError(
        fmt::format("cell {} has {} points; its shape requires {}", cell, points.size(), points_per_cell(shape)));
  for (const LocalFace& local : local_faces(shape)) {
    std::array<Index, 4> face{};
    const std::size_t n = local[3] < 0 ? 3 : 4;
    for (std::size_t i = 0; i < n; ++i) face[i] = points[local[i]];
    halves.add(cell, std::span(face).first(n));
  }
}

}  // namespace

Index points_per_cell(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron: return 4;
    case CellShape::wedge: return 6;
    case CellShape::pyramid: return 5;
    case CellShape::hexahedron: return 8;
    case CellShape::polyhedron: break;
  }
  return 0;
}

double signed_cell_volume(const std::vector<Vector>& points, CellShape shape, std::span<const Index> cell) {
  std::vector<Polygon> faces;
  for (const LocalFace& local : local_faces(shape)) {
    Polygon& face = faces.emplace_back();
    for (const Index i : local)
      if (i >= 0) face.push_back(cell[i]);
  }
  return signed_volume(faces, points);
}

HalfFaces half_faces(const CellSoup& soup) {
  HalfFaces halves;
  halves.cell.reserve(soup.shape.size() * 5);
  halves.offsets.reserve(soup.shape.size() * 5 + 1);
  halves.points.reserve(soup.cell_points.size() * 3);
  std::size_t polyhedron = 0;
  for (Index c = 0; c < count_of(soup.shape); ++c) {
    if (soup.shape[c] == CellShape::polyhedron) {
      std::vector<Polygon> faces = unpack_polyhedron(soup.polyhedron_faces[polyhedron++], c, soup.points.size());
      orient_outwards(faces, soup.points, c);
      for (const Polygon& face : faces) halves.add(c, face);
    } else {
      const Index first = soup.cell_offsets[c];
      const auto n = static_cast<std::size_t>(soup.cell_offsets[c + 1] - first);
      add_standard_cell(halves, c, soup.shape[c], {soup.cell_points.data() + first, n});
    }
  }
  return halves;
}

std::vector<FacePair> pair_half_faces(const HalfFaces& halves, Index n_points) {
  std::vector<Index> sorted = halves.points;
  const auto key = [&](Index h) {
    const Index first = halves.offsets[h];
    return std::span<Index>{sorted.data() + first, static_cast<std::size_t>(halves.offsets[h + 1] - first)};
  };
  // Half-faces in buckets by their smallest point: a bucket holds a few dozens, so sorting inside is cheap.
  std::vector<Index> bucket_start(n_points + 1, 0);
  for (Index h = 0; h < halves.size(); ++h) {
    std::sort(key(h).begin(), key(h).end());
    ++bucket_start[key(h)[0] + 1];
  }
  std::partial_sum(bucket_start.begin(), bucket_start.end(), bucket_start.begin());
  std::vector<Index> bucketed(halves.cell.size());
  std::vector<Index> fill(bucket_start.begin(), bucket_start.end() - 1);
  for (Index h = 0; h < halves.size(); ++h) bucketed[fill[key(h)[0]]++] = h;

  const auto compare = [&](Index a, Index b) {
    const auto order =
        std::lexicographical_compare_three_way(key(a).begin(), key(a).end(), key(b).begin(), key(b).end());
    return order != 0 ? order < 0 : a < b;  // NOLINT(modernize-use-nullptr): no pointers
  };
  const auto equal = [&](Index a, Index b) { return std::ranges::equal(key(a), key(b)); };
  std::vector<FacePair> pairs;
  for (Index p = 0; p < n_points; ++p) {
    std::sort(bucketed.begin() + bucket_start[p], bucketed.begin() + bucket_start[p + 1], compare);
    for (Index i = bucket_start[p]; i < bucket_start[p + 1];) {
      Index end = i + 1;
      while (end < bucket_start[p + 1] && equal(bucketed[i], bucketed[end])) ++end;
      if (end - i > 2)
        throw InputError(fmt::format("{} cells share one face, at most two may; among them are cells {}, {} and {}",
                                     end - i, halves.cell[bucketed[i]], halves.cell[bucketed[i + 1]],
                                     halves.cell[bucketed[i + 2]]));
      pairs.push_back({bucketed[i], end - i == 2 ? bucketed[i + 1] : -1});
      i = end;
    }
  }
  return pairs;
}

void list_faces_of_cells(Mesh& mesh) {
  std::vector<Index>& offsets = mesh.cell_face_offsets;
  offsets.assign(mesh.n_cells() + 1, 0);
  for (const Index c : mesh.owner) ++offsets[c + 1];
  for (const Index c : mesh.neighbour) ++offsets[c + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  mesh.cell_faces.resize(offsets.back());
  std::vector<Index> fill(offsets.begin(), offsets.end() - 1);
  for (Index f = 0; f < mesh.n_faces(); ++f) {
    mesh.cell_faces[fill[mesh.owner[f]]++] = f;
    if (mesh.is_interior(f)) mesh.cell_faces[fill[mesh.neighbour[f]]++] = f;
  }
}

void mirror_cell(CellShape shape, std::vector<Index>& p) {
  if (shape == CellShape::pyramid || shape == CellShape::hexahedron)
    std::swap(p[1], p[3]);
  else
    std::swap(p[1], p[2]);
  if (shape == CellShape::wedge) std::swap(p[4], p[5]);
  if (shape == CellShape::hexahedron) std::swap(p[5], p[7]);
}

}  // namespace pfdm
