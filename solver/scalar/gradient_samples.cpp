#include "solver/scalar/gradient_samples.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double parallel = 1.0 - 1e-4;  // cosine

bool is_triangle(const Mesh& mesh, Index face) { return mesh.points_of_face(face).size() == 3; }

/// Normal of a prism's triangles, if they are parallel; else, and of other cells, zero.
Vector normal_of_triangles(const Mesh& mesh, Index cell) {
  Vector normal = Vector::Zero();
  if (mesh.shape[cell] != CellShape::wedge) return normal;
  for (const Index f : mesh.faces_of_cell(cell)) {
    if (!is_triangle(mesh, f)) continue;
    const Vector n = mesh.face_area[f].normalized();
    if (!normal.isZero() && std::abs(n.dot(normal)) < parallel) return Vector::Zero();
    normal = n;
  }
  return normal;
}

/// Whether a prism's triangle is between the cells.
bool is_above(const Mesh& mesh, Index cell, Index other) {
  return std::ranges::any_of(mesh.faces_of_cell(cell), [&](Index f) {
    return mesh.is_interior(f) && mesh.across(f, cell) == other && is_triangle(mesh, f);
  });
}

}  // namespace

GradientSampling::GradientSampling(const Mesh& mesh, const GradientSettings& settings, const std::vector<Vector>& node)
    : mesh_(mesh), settings_(settings), node_(node), wide_(as_size(mesh.n_cells()), 0) {
  for (Index c = 0; c < mesh.n_cells(); ++c) wide_[c] = mesh.shape[c] == CellShape::tetrahedron ? 1 : 0;
  if (settings.wide_triangles != WideTriangles::none) widen_prisms();
}

CellSamples GradientSampling::about(Index cell) const {
  constexpr int most_rings = 5;
  CellSamples found{.wide = wide_[cell] != 0};
  int n_rings = found.wide ? 2 : 1;
  found.samples = rings(cell, n_rings, found.wide && mesh_.shape[cell] == CellShape::wedge);
  while (!has_full_rank(cell, found.samples) && ++n_rings <= most_rings) found.samples = rings(cell, n_rings, false);
  if (n_rings <= most_rings) return found;
  const Vector& at = node_[cell];
  if (!settings_.zero_if_deficient)
    throw InputError(
        fmt::format("the gradient of cell {} at ({:.4g}, {:.4g}, {:.4g}) m cannot be reconstructed: the cell has too "
                    "few neighbours of its own material; refine the mesh there",
                    cell, at[0], at[1], at[2]));
  found.samples.clear();
  return found;
}

// One ring of flat triangles enlarges differences of its samples, taken to a side, by 0.9 (squares) to 1.4 where
// diagonals alternate, by at most 0.88 where they do not. Elasticity on the former is indefinite from boxes twice as
// long as high on, and cracks in them do not end. In space, where formulas of bending are those of one ring, squares
// keep it. At surfaces both are alike: cells there follow those beside them. In plane meshes two rings have a quarter
// of the error of one, but where layers bend.
void GradientSampling::widen_prisms() {
  const bool is_plane = !settings_.plane_normal.isZero();
  const double most = is_plane ? 0.89 : 1.1;
  std::vector<char> within(wide_.size(), 0), at_surface(wide_.size(), 0);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (mesh_.shape[c] != CellShape::wedge || (is_plane && !lies_in_plane(c))) return;
    if (is_plane && settings_.wide_triangles == WideTriangles::in_plane) {
      within[c] = 1;
      return;
    }
    const Vector normal = normal_of_triangles(mesh_, c);
    if (!is_plane && (normal.isZero() || !is_of_plane_layer(c, normal))) return;
    const std::vector<GradientSample> ring = rings(c, 1, false);
    if (!has_full_rank(c, ring)) return;
    if (has_surface_beside(c))
      at_surface[c] = 1;
    else
      within[c] = largest_rise(c, ring) > most ? 1 : 0;
  });
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const auto follows = [&](Index f) { return mesh_.is_interior(f) && within[mesh_.across(f, c)] != 0; };
    if (within[c] != 0 || (at_surface[c] != 0 && std::ranges::any_of(sides(c), follows))) wide_[c] = 1;
  });
}

// About an axis the two planes are turned by half of the sector each; wedges on the axis have triangles across it.
bool GradientSampling::lies_in_plane(Index prism) const {
  return std::ranges::all_of(mesh_.faces_of_cell(prism), [&](Index f) {
    return !is_triangle(mesh_, f) || std::abs(mesh_.face_area[f].normalized().dot(settings_.plane_normal)) > 0.9;
  });
}

std::vector<Index> GradientSampling::sides(Index prism) const {
  std::vector<Index> found;
  for (const Index f : mesh_.faces_of_cell(prism))
    if (!is_triangle(mesh_, f)) found.push_back(f);
  return found;
}

bool GradientSampling::has_surface_beside(Index prism) const {
  return std::ranges::any_of(sides(prism), [&](Index f) {
    return !mesh_.is_interior(f) || node_beside(prism, f) >= 0 || is_cut(f) ||
           settings_.zone[mesh_.across(f, prism)] != settings_.zone[prism];
  });
}

bool GradientSampling::is_of_plane_layer(Index prism, const Vector& normal) const {
  return std::ranges::all_of(sides(prism), [&](Index f) {
    if (!mesh_.is_interior(f)) return true;
    const Index other = mesh_.across(f, prism);
    return mesh_.shape[other] != CellShape::wedge ||
           std::abs(normal_of_triangles(mesh_, other).dot(normal)) >= parallel;
  });
}

// By how much the gradient of these samples enlarges their differences, taken to a side of a prism.
double GradientSampling::largest_rise(Index cell, const std::vector<GradientSample>& samples) const {
  const Vector& here = node_[cell];
  Tensor moment = Tensor::Zero();
  std::vector<Vector> weighted;
  for (const GradientSample& sample : samples) {
    const Vector d = node_[sample.node] - here;
    weighted.emplace_back(d / std::pow(d.norm(), 3));
    moment.noalias() += weighted.back() * d.transpose();
  }
  moment += moment.trace() * settings_.plane_normal * settings_.plane_normal.transpose();
  const Eigen::LLT<Tensor> factor(moment);
  double largest = 0.0;
  for (const Index f : sides(cell)) {
    const Vector to_side = factor.solve(mesh_.face_centre[f] - here);
    double rise = 0.0;
    for (const Vector& w : weighted) rise += std::abs(w.dot(to_side));
    largest = std::max(largest, rise);
  }
  return largest;
}

// Tetrahedra do not ask what is between: with that a bead in an incompressible binder took half as many iterations
// again.
std::vector<GradientSample> GradientSampling::rings(Index cell, int n, bool within_layer) const {
  const bool is_prism = mesh_.shape[cell] == CellShape::wedge;
  std::vector<GradientSample> cells{{cell}}, nodes;
  std::size_t ring_begin = 0;
  for (int ring = 0; ring < n; ++ring) {
    const std::size_t ring_end = cells.size();
    for (std::size_t i = ring_begin; i < ring_end; ++i) {
      const Index from = cells[i].node;
      if (ring > 0 && within_layer && is_above(mesh_, cell, from)) continue;
      extend({.cell = from, .is_between = is_prism && ring > 0, .within_layer = within_layer && ring > 0}, cells,
             nodes);
    }
    ring_begin = ring_end;
  }
  cells.erase(cells.begin());
  std::ranges::sort(cells, {}, &GradientSample::node);
  std::ranges::sort(nodes, {}, &GradientSample::node);
  cells.insert(cells.end(), nodes.begin(), nodes.end());
  return cells;
}

void GradientSampling::extend(const Way& way, std::vector<GradientSample>& cells,
                              std::vector<GradientSample>& nodes) const {
  const auto add = [&](Index node, std::vector<GradientSample>& list) {
    if (std::ranges::find(list, node, &GradientSample::node) == list.end())
      list.push_back({node, way.is_between ? way.cell : -1});
  };
  for (const Index face : mesh_.faces_of_cell(way.cell)) {
    if (way.within_layer && is_triangle(mesh_, face)) continue;
    if (const Index node = node_beside(way.cell, face); node >= 0) {
      add(node, nodes);
    } else if (mesh_.is_interior(face) && !is_cut(face)) {
      const Index other = mesh_.across(face, way.cell);
      if (settings_.zone[other] == settings_.zone[way.cell]) add(other, cells);
    }
  }
}

Index GradientSampling::node_beside(Index cell, Index face) const {
  if (settings_.neighbour_node.size() > 0 && settings_.neighbour_node[face] >= 0 && mesh_.owner[face] != cell)
    return settings_.neighbour_node[face];
  return settings_.node_of_face.size() > 0 ? settings_.node_of_face[face] : -1;
}

bool GradientSampling::has_full_rank(Index cell, const std::vector<GradientSample>& samples) const {
  Tensor moment = settings_.plane_normal * settings_.plane_normal.transpose();
  for (const GradientSample& sample : samples) {
    const Vector d = (node_[sample.node] - node_[cell]).normalized();
    moment += d * d.transpose();
  }
  constexpr double least = 1e-3;
  // The product of the other two eigenvalues is at most (trace/2)^2: most cells need no eigenvalues.
  if (4.0 * moment.determinant() > 1.01 * least * moment.trace() * moment.trace()) return true;
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(moment, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] > least;
}

}  // namespace pfdm
