#include "mesh/mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/cell_faces.h"
#include "mesh/cell_ordering.h"
#include "mesh/geometry.h"
#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

constexpr double closure_tolerance = 1e-9;  // |sum of area vectors| over sum of areas
const std::string default_patch = "walls";

void check_soup(const CellSoup& soup) {
  const std::size_t n = soup.shape.size();
  if (n == 0) throw InputError("the mesh has no cells");
  if (soup.cell_offsets.size() != n + 1 || soup.region.size() != n)
    throw InputError("the lists of cells have different lengths");
  const auto in_range = [](const std::vector<Index>& list, std::size_t size) {
    return std::ranges::all_of(list, [size](Index i) { return i >= 0 && static_cast<std::size_t>(i) < size; });
  };
  if (!in_range(soup.cell_points, soup.points.size())) throw InputError("a cell refers to a point that does not exist");
  if (!in_range(soup.region, soup.region_names.size()))
    throw InputError("a cell refers to a region that does not exist");
  if (!std::ranges::all_of(soup.points, [](const Vector& x) { return x.allFinite(); }))
    throw InputError("a point of the mesh has a coordinate that is not a number");
}

std::vector<Index> order_for_locality(const HalfFaces& halves, const std::vector<FacePair>& pairs, Index n_cells) {
  std::vector<std::pair<Index, Index>> neighbours;
  neighbours.reserve(pairs.size());
  for (const FacePair& pair : pairs)
    if (pair.second >= 0) neighbours.emplace_back(halves.cell[pair.first], halves.cell[pair.second]);
  return reverse_cuthill_mckee(n_cells, neighbours);
}

void copy_cells(Mesh& mesh, const CellSoup& soup, const std::vector<Index>& order) {
  mesh.cell_offsets = {0};
  mesh.cell_points.reserve(soup.cell_points.size());
  for (const Index old : order) {
    mesh.shape.values().push_back(soup.shape[old]);
    mesh.region.values().push_back(soup.region[old]);
    mesh.cell_points.insert(mesh.cell_points.end(), soup.cell_points.begin() + soup.cell_offsets[old],
                            soup.cell_points.begin() + soup.cell_offsets[old + 1]);
    mesh.cell_offsets.push_back(count_of(mesh.cell_points));
  }
}

// A face about to be placed: its half-face on the owner's side, its rank among patches (interior -1), its apex (-1: the
// mean of its points).
struct PlacedFace {
  Index owner, neighbour, half_face, patch, apex;
};

std::vector<PlacedFace> place_faces(const FaceTable& table, const std::vector<Index>& order) {
  const HalfFaces& halves = table.halves;
  std::vector<Index> new_number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) new_number[order[i]] = static_cast<Index>(i);
  std::vector<PlacedFace> faces;
  faces.reserve(table.pairs.size());
  for (std::size_t i = 0; i < table.pairs.size(); ++i) {
    const FacePair& pair = table.pairs[i];
    const Index apex = table.apex.empty() ? -1 : table.apex[i];
    const Index a = new_number[halves.cell[pair.first]];
    const Index b = pair.second < 0 ? -1 : new_number[halves.cell[pair.second]];
    if (b < 0)
      faces.push_back({a, -1, pair.first, table.patch[i], apex});
    else if (a == b)
      throw InputError(fmt::format("cell {} has one face twice", halves.cell[pair.first]));
    else
      faces.push_back({std::min(a, b), std::max(a, b), a < b ? pair.first : pair.second, -1, apex});
  }
  return faces;
}

Index patch_slot(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<Index>(found - names.begin());
  names.push_back(name);
  return static_cast<Index>(names.size() - 1);
}

// Gives each boundary face its patch; rules of one name share a patch.
void claim_boundary(FaceTable& table, const std::vector<Vector>& points, const std::vector<PatchRule>& rules) {
  std::vector<Index> slot;
  slot.reserve(rules.size());
  for (const PatchRule& rule : rules) slot.push_back(patch_slot(table.patch_names, rule.name));
  std::vector<bool> used(rules.size(), false);
  table.patch.assign(table.pairs.size(), -1);
  for (std::size_t i = 0; i < table.pairs.size(); ++i) {
    if (table.pairs[i].second >= 0) continue;
    const auto ids = table.halves.points_of(table.pairs[i].first);
    const FaceGeometry geometry = face_geometry(points, ids);
    const Vector normal = geometry.area.normalized();
    std::size_t r = 0;
    while (r < rules.size() && !rules[r].holds(geometry.centre, normal, ids)) ++r;
    if (r < rules.size()) used[r] = true;
    table.patch[i] = r < rules.size() ? slot[r] : patch_slot(table.patch_names, default_patch);
  }
  for (std::size_t r = 0; r < rules.size(); ++r)
    if (!used[r] && rules[r].required)
      throw InputError(fmt::format("no boundary face of the mesh belongs to patch \"{}\"", rules[r].name));
}

void store_faces(Mesh& mesh, std::vector<PlacedFace>& faces, const FaceTable& table) {
  std::ranges::stable_sort(faces, [](const PlacedFace& a, const PlacedFace& b) {
    return std::tie(a.patch, a.owner, a.neighbour) < std::tie(b.patch, b.owner, b.neighbour);
  });
  for (const std::string& name : table.patch_names) mesh.patches.push_back({name, 0, 0});
  mesh.face_offsets = {0};
  for (const PlacedFace& face : faces) {
    mesh.owner.values().push_back(face.owner);
    if (face.neighbour >= 0) mesh.neighbour.values().push_back(face.neighbour);
    if (face.patch >= 0) ++mesh.patches[face.patch].n_faces;
    if (face.apex >= 0) mesh.face_apex.values().push_back(face.apex);
    const auto ids = table.halves.points_of(face.half_face);
    mesh.face_points.insert(mesh.face_points.end(), ids.begin(), ids.end());
    mesh.face_offsets.push_back(count_of(mesh.face_points));
  }
  Index next = mesh.n_interior_faces();
  for (Patch& patch : mesh.patches) {
    patch.first_face = next;
    next += patch.n_faces;
  }
  std::erase_if(mesh.patches, [](const Patch& patch) { return patch.n_faces == 0; });
}

// A cell's area vectors do not sum to zero when two cells overlap: the shared face then has both on one side.
void check_cells(const Mesh& mesh, const std::vector<Index>& order) {
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Vector sum = Vector::Zero();
    double total = 0.0;
    for (const Index f : mesh.faces_of_cell(c)) {
      sum += mesh.outward_area(f, c);
      total += mesh.face_area[f].norm();
    }
    if (!(sum.norm() <= closure_tolerance * total))
      throw InputError(
          fmt::format("cell {} does not close: it overlaps a neighbour, or its points are out of order", order[c]));
    if (!(mesh.cell_volume[c] > 1e-15 * portable::pow(total, 1.5)))
      throw InputError(fmt::format("cell {} has the volume {}, which is not positive", order[c],
                                   quantity_text(mesh.cell_volume[c], "m^3", 6)));
  }
}

}  // namespace

Index Mesh::patch_index(const std::string& name) const {
  const auto found = std::ranges::find(patches, name, &Patch::name);
  if (found != patches.end()) return static_cast<Index>(found - patches.begin());
  std::vector<std::string> names;
  for (const Patch& p : patches) names.push_back(p.name);
  throw InputError(fmt::format("unknown patch \"{}\"; available: {}", name, fmt::join(names, ", ")));
}

Index Mesh::region_index(const std::string& name) const {
  const auto found = std::ranges::find(region_names, name);
  if (found != region_names.end()) return static_cast<Index>(found - region_names.begin());
  throw InputError(fmt::format("unknown region \"{}\"; available: {}", name, fmt::join(region_names, ", ")));
}

void CellSoup::add_cell(CellShape cell_shape, std::span<const Index> ids, Index cell_region) {
  shape.push_back(cell_shape);
  region.push_back(cell_region);
  cell_points.insert(cell_points.end(), ids.begin(), ids.end());
  cell_offsets.push_back(count_of(cell_points));
}

Mesh assemble_mesh(CellSoup soup, const std::vector<PatchRule>& rules) {
  check_soup(soup);
  if (count_of(soup.polyhedron_faces) != std::ranges::count(soup.shape, CellShape::polyhedron))
    throw InputError("the lists of cells have different lengths");
  FaceTable table;
  table.halves = half_faces(soup);
  table.pairs = pair_half_faces(table.halves, count_of(soup.points));
  claim_boundary(table, soup.points, rules);
  return assemble_from_faces(std::move(soup), table);
}

Mesh assemble_from_faces(CellSoup soup, const FaceTable& table) {
  check_soup(soup);
  const std::vector<Index> order = order_for_locality(table.halves, table.pairs, count_of(soup.shape));
  std::vector<PlacedFace> faces = place_faces(table, order);
  Mesh mesh;
  copy_cells(mesh, soup, order);
  store_faces(mesh, faces, table);
  list_faces_of_cells(mesh);
  mesh.points = std::move(soup.points);
  mesh.region_names = std::move(soup.region_names);
  compute_geometry(mesh);
  check_cells(mesh, order);
  return mesh;
}

}  // namespace pfdm
