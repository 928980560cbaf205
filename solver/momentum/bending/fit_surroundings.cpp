#include "solver/momentum/bending/fit_surroundings.h"

#include "mesh/search/line_walk.h"
#include "solver/momentum/bending/bending_layers.h"

#include <algorithm>

namespace pfdm {
namespace {

void unite(std::vector<Index>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

bool share_a_point(const Mesh& mesh, Index cell, Index other) {
  const auto points = mesh.points_of_cell(cell);
  return std::ranges::any_of(mesh.points_of_cell(other),
                             [&](Index p) { return std::ranges::find(points, p) != points.end(); });
}

}  // namespace

std::vector<Index> FitSurroundings::of(Index cell) {
  if (mesh_.shape[cell] == CellShape::wedge) return of_prism(cell);
  cells_.clear();
  nodes_.clear();
  corners_.clear();
  for (const Index f : mesh_.faces_of_cell(cell)) {
    if (const Index other = beyond(cell, f); other >= 0) cells_.push_back(other);
  }
  for (const Index f : mesh_.faces_of_cell(cell))
    if (const Index other = across(cell, f); other >= 0) extend(cell, other, f);
  std::sort(corners_.begin(), corners_.end());
  for (std::size_t i = 0; i + 1 < corners_.size(); ++i)
    if (corners_[i] == corners_[i + 1]) cells_.push_back(corners_[i]);
  return samples(cell);
}

std::vector<Index> FitSurroundings::samples(Index cell) {
  unite(cells_);
  std::erase(cells_, cell);
  unite(nodes_);
  cells_.insert(cells_.end(), nodes_.begin(), nodes_.end());
  return cells_;
}

// Cubics on fewer samples made the operator indefinite.
std::vector<Index> FitSurroundings::of_prism(Index cell) {
  cells_ = {cell};
  nodes_.clear();
  const auto add_beyond = [&](Index from, bool is_at_point) {
    for (const Index f : mesh_.faces_of_cell(from)) {
      const Index other = across(from, f);
      if (other < 0 || std::ranges::find(cells_, other) != cells_.end()) continue;
      if (is_at_point && !share_a_point(mesh_, cell, other)) continue;
      if (sees(cell, other, mesh_.cell_centre[other])) cells_.push_back(other);
    }
  };
  // It grows meanwhile. NOLINTNEXTLINE(modernize-loop-convert)
  for (std::size_t i = 0; i < cells_.size(); ++i) add_beyond(cells_[i], true);
  const std::size_t n_at_points = cells_.size();
  for (std::size_t i = 0; i < n_at_points; ++i) add_beyond(cells_[i], false);
  for (const Index c : cells_)
    for (const Index f : mesh_.faces_of_cell(c))
      if (const Index node = unknowns_.node_beside(mesh_, c, f); node >= 0 && sees(cell, c, mesh_.face_centre[f]))
        nodes_.push_back(node);
  return samples(cell);
}

// Whether the line from the centre of a cell to a place in another one runs through no face with a node.
bool FitSurroundings::sees(Index cell, Index other, const Vector& place) const {
  const Vector step = place - mesh_.cell_centre[cell];
  for (const LineSegment& in :
       walk_line(mesh_, cell, mesh_.cell_centre[cell], step.normalized(), (1.0 - 1e-6) * step.norm())) {
    if (in.cell == other) return true;
    if (in.exit < 0 || across(in.cell, in.exit) < 0) return false;
  }
  return false;
}

Index FitSurroundings::across(Index cell, Index face) const {
  if (!mesh_.is_interior(face) || unknowns_.node_beside(mesh_, cell, face) >= 0) return -1;
  return mesh_.across(face, cell);
}

// The cell across a face, or else its node is added.
Index FitSurroundings::beyond(Index cell, Index face) {
  if (const Index node = unknowns_.node_beside(mesh_, cell, face); node >= 0) nodes_.push_back(node);
  return across(cell, face);
}

// Beyond the neighbour across `face`.
void FitSurroundings::extend(Index cell, Index neighbour, Index face) {
  const Index opposite = opposite_face(mesh_, neighbour, face);
  for (const Index f : mesh_.faces_of_cell(neighbour)) {
    if (f == face) continue;
    const Index other = beyond(neighbour, f);
    if (other < 0 || other == cell) continue;
    (f == opposite ? cells_ : corners_).push_back(other);
  }
}

}  // namespace pfdm
