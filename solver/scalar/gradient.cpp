#include "solver/scalar/gradient.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Face neighbours of the same zone and face nodes, ring by ring.
class Neighbourhood {
 public:
  Neighbourhood(const Mesh& mesh, const GradientSettings& settings) : mesh_(mesh), settings_(settings) {}

  /// Cells, then nodes on faces, by number.
  std::vector<GradientSample> around(Index cell, int n_rings) const {
    std::vector<GradientSample> cells{{cell}}, nodes;
    std::size_t ring_begin = 0;
    for (int ring = 0; ring < n_rings; ++ring) {
      const std::size_t ring_end = cells.size();
      for (std::size_t i = ring_begin; i < ring_end; ++i) extend(cells[i].node, ring > 0, cells, nodes);
      ring_begin = ring_end;
    }
    cells.erase(cells.begin());
    std::ranges::sort(cells, {}, &GradientSample::node);
    std::ranges::sort(nodes, {}, &GradientSample::node);
    cells.insert(cells.end(), nodes.begin(), nodes.end());
    return cells;
  }

 private:
  void extend(Index cell, bool is_between, std::vector<GradientSample>& cells,
              std::vector<GradientSample>& nodes) const {
    const auto add = [&](Index node, std::vector<GradientSample>& list) {
      if (std::ranges::find(list, node, &GradientSample::node) == list.end())
        list.push_back({node, is_between ? cell : -1});
    };
    for (const Index face : mesh_.faces_of_cell(cell)) {
      if (const Index node = node_beside(cell, face); node >= 0) {
        add(node, nodes);
      } else if (mesh_.is_interior(face) && !is_cut(face)) {
        const Index other = mesh_.across(face, cell);
        if (settings_.zone[other] == settings_.zone[cell]) add(other, cells);
      }
    }
  }

  Index node_beside(Index cell, Index face) const {
    if (settings_.neighbour_node.size() > 0 && settings_.neighbour_node[face] >= 0 && mesh_.owner[face] != cell)
      return settings_.neighbour_node[face];
    return settings_.node_of_face.size() > 0 ? settings_.node_of_face[face] : -1;
  }

  bool is_cut(Index face) const { return settings_.cut.size() > 0 && settings_.cut[face] != 0; }

  const Mesh& mesh_;
  const GradientSettings& settings_;
};

std::vector<Vector> node_positions(const Mesh& mesh, const GradientSettings& settings) {
  std::vector<Vector> position(mesh.cell_centre.begin(), mesh.cell_centre.end());
  for (Index c = 0; c < settings.shift.size(); ++c) position[c] += settings.shift[c];
  for (const FaceField<Index>* nodes : {&settings.node_of_face, &settings.neighbour_node})
    for (Index f = 0; f < nodes->size(); ++f) {
      const std::size_t node = (*nodes)[f];
      if ((*nodes)[f] < 0) continue;
      if (position.size() <= node) position.resize(node + 1);
      position[node] = mesh.face_centre[f];
    }
  return position;
}

// Prisms about an axis, whose triangles are normal to it, are none.
bool is_triangle_of_plane(const Mesh& mesh, Index cell, const Vector& normal) {
  if (mesh.shape[cell] != CellShape::wedge || normal.isZero()) return false;
  return std::ranges::any_of(mesh.faces_of_cell(cell), [&](Index f) {
    return mesh.points_of_face(f).size() == 3 && std::abs(mesh.face_area[f].normalized().dot(normal)) > 0.9;
  });
}

}  // namespace

Gradient::Gradient(const Mesh& mesh, const GradientSettings& settings)
    : node_(node_positions(mesh, settings)),
      wide_(mesh.n_cells()),
      polyhedron_(mesh.n_cells()),
      g_(mesh.n_cells(), 1.0),
      plane_normal_(settings.plane_normal) {
  const Neighbourhood neighbourhood(mesh, settings);
  offsets_.push_back(0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!settings.wanted.empty() && settings.wanted[c] == 0) {
      offsets_.push_back(sample_.size());
      continue;
    }
    const bool wide = mesh.shape[c] == CellShape::tetrahedron ||
                      (settings.wide_triangles && is_triangle_of_plane(mesh, c, plane_normal_));
    wide_[c] = wide;
    polyhedron_[c] = mesh.shape[c] == CellShape::polyhedron;
    constexpr int most_rings = 5;
    int n_rings = wide ? 2 : 1;
    std::vector<GradientSample> samples = neighbourhood.around(c, n_rings);
    while (!has_full_rank(c, samples) && ++n_rings <= most_rings) samples = neighbourhood.around(c, n_rings);
    if (n_rings > most_rings && settings.zero_if_deficient) samples.clear();
    if (n_rings > most_rings && !settings.zero_if_deficient)
      throw InputError(
          fmt::format("the gradient of cell {} at ({:.4g}, {:.4g}, {:.4g}) m cannot be reconstructed: the cell has too "
                      "few neighbours of its own material; refine the mesh there",
                      c, node_[c][0], node_[c][1], node_[c][2]));
    for (const GradientSample& sample : samples) {
      sample_.push_back(sample.node);
      through_.push_back(sample.through);
    }
    offsets_.push_back(sample_.size());
  }
  coefficient_.resize(sample_.size());
  parallel_for(n_cells(), [&](Index c) { build(c, nullptr); });
}

bool Gradient::has_full_rank(Index cell, const std::vector<GradientSample>& samples) const {
  Tensor moment = plane_normal_ * plane_normal_.transpose();
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

double Gradient::trust(Index cell, std::size_t sample, const CellField<double>& g) const {
  double least = sample_[sample] < n_cells() ? g[sample_[sample]] : g[cell];
  if (through_[sample] >= 0) least = std::min(least, g[through_[sample]]);
  const double ratio = least / g[cell];
  if (polyhedron_[cell]) return std::min(ratio, 1.0 / ratio);
  return std::min(1.0, ratio);
}

void Gradient::build(Index cell, const CellField<double>* g) {
  const Vector here = node_[cell];
  Tensor moment = Tensor::Zero();
  double trace = 0.0;
  for (std::size_t s = begin(cell); s < end(cell); ++s) {
    const Index j = sample_[s];
    const Vector d = node_[j] - here;
    const double length2 = d.squaredNorm();
    double weight = 1.0 / length2;
    if (!wide_[cell]) weight /= std::sqrt(length2);
    trace += weight * length2;
    constexpr double least = 1e-9;
    if (j < n_cells() || through_[s] >= 0) weight *= (g != nullptr ? trust(cell, s, *g) : 1.0) + least;
    coefficient_[s] = weight * d;
    moment.noalias() += coefficient_[s] * d.transpose();
  }
  moment += trace * plane_normal_ * plane_normal_.transpose();
  const Eigen::LLT<Tensor> factor(moment);
  for (std::size_t s = begin(cell); s < end(cell); ++s) factor.solveInPlace(coefficient_[s]);
}

void Gradient::update(const CellField<double>& g, double part) {
  const CellField<double> before = g_;
  parallel_for(n_cells(), [&](Index c) {
    if (std::abs(g[c] - before[c]) > part * before[c]) g_[c] = g[c];
  });
  parallel_for(n_cells(), [&](Index c) {
    bool changed = g_[c] != before[c];
    bool flat = true;
    for (std::size_t s = begin(c); s < end(c); ++s) {
      const Index j = sample_[s];
      if (j < n_cells()) changed = changed || g_[j] != before[j];
      flat = flat && trust(c, s, g_) == 1.0 && trust(c, s, before) == 1.0;
    }
    if (changed && !flat) build(c, &g_);
  });
}

}  // namespace pfdm
