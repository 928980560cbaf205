#include "solver/scalar/gradient.h"

#include "solver/parallel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

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

}  // namespace

Gradient::Gradient(const Mesh& mesh, const GradientSettings& settings)
    : node_(node_positions(mesh, settings)),
      wide_(mesh.n_cells()),
      polyhedron_(mesh.n_cells()),
      g_(mesh.n_cells(), 1.0),
      plane_normal_(settings.plane_normal) {
  const GradientSampling sampling(mesh, settings, node_);
  offsets_.push_back(0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    polyhedron_[c] = mesh.shape[c] == CellShape::polyhedron;
    if (settings.wanted.empty() || settings.wanted[c] != 0) {
      const CellSamples found = sampling.about(c);
      wide_[c] = found.wide;
      for (const GradientSample& sample : found.samples) {
        sample_.push_back(sample.node);
        through_.push_back(sample.through);
      }
    }
    offsets_.push_back(sample_.size());
  }
  coefficient_.resize(sample_.size());
  parallel_for(n_cells(), [&](Index c) { build(c, nullptr); });
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
