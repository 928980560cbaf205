#include "solver/fracture/damage/vertex_means.h"

#include "solver/parallel.h"

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

constexpr double least_weight = 0.25, most_weight = 4.0;  // before they are divided by their sum

// Directions across the surface at a point, orthonormal.
struct Normals {
  std::array<Vector, 3> direction;
  std::size_t n = 0;

  void add(Vector normal) {
    constexpr double another = 0.5;  // sine of the angle to those that are there
    normal = along(normal);
    if (n < 3 && normal.norm() > another) direction[n++] = normal.normalized();
  }
  Vector along(Vector r) const {
    for (std::size_t i = 0; i < n; ++i) r -= direction[i].dot(r) * direction[i];
    return r;
  }
};

// Weights of sum 1 that make the mean of r, which have no part in the directions of `across`, vanish.
std::vector<double> weights_of(const std::vector<Vector>& r, const Normals& across) {
  Tensor square = Tensor::Zero();
  Vector sum = Vector::Zero();
  for (const Vector& x : r) {
    square += x * x.transpose();
    sum += x;
  }
  const double size = square.trace();
  for (std::size_t i = 0; i < across.n; ++i) square += size * across.direction[i] * across.direction[i].transpose();
  constexpr double regular = 1e-6;
  Vector lambda = Vector::Zero();
  if (square.determinant() > regular * size * size * size) lambda = -(square.inverse() * sum);
  std::vector<double> weights;
  double all = 0.0;
  for (const Vector& x : r) all += weights.emplace_back(std::clamp(1.0 + lambda.dot(x), least_weight, most_weight));
  for (double& w : weights) w /= all;
  return weights;
}

// Second moment without its parts between surface and normals, which cancel with the mirror image.
Tensor mirrored(const Tensor& moment, const Normals& across) {
  Tensor along = Tensor::Identity();
  for (std::size_t i = 0; i < across.n; ++i) along -= across.direction[i] * across.direction[i].transpose();
  const Tensor normal = Tensor::Identity() - along;
  return along * moment * along + normal * moment * normal;
}

}  // namespace

VertexMeans::VertexMeans(const Mesh& mesh, std::vector<Index> cells)
    : mesh_(&mesh), cells_(std::move(cells)), is_averaged_(mesh.n_cells(), 0) {
  std::vector<Index> vertex_of_point(mesh.points.size(), -1), points;
  for (const Index c : cells_) {
    is_averaged_[c] = 1;
    for (const Index p : mesh.points_of_cell(c)) {
      if (vertex_of_point[p] >= 0) continue;
      vertex_of_point[p] = count_of(points);
      points.push_back(p);
    }
  }
  weigh_cells_around_vertices(points, vertex_of_point);
  weigh_vertices(vertex_of_point);
  cells_of_vertex_transposed_ = cells_of_vertex_.transposed(mesh.n_cells());
  vertices_transposed_ = vertices_of_cell_.transposed(points.size());
}

void VertexMeans::weigh_cells_around_vertices(const std::vector<Index>& points,
                                              const std::vector<Index>& vertex_of_point) {
  std::vector<std::vector<Index>> cells(points.size());
  for (Index c = 0; c < mesh_->n_cells(); ++c)
    for (const Index p : mesh_->points_of_cell(c))
      if (const Index v = vertex_of_point[p]; v >= 0) cells[v].push_back(c);
  std::vector<Normals> across(points.size());
  for (Index f = mesh_->n_interior_faces(); f < mesh_->n_faces(); ++f)
    for (const Index p : mesh_->points_of_face(f))
      if (const Index v = vertex_of_point[p]; v >= 0) across[v].add(mesh_->face_area[f].normalized());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vector x = mesh_->points[points[v]];
    std::vector<Vector> r;
    for (const Index c : cells[v]) r.push_back(across[v].along(mesh_->cell_centre[c] - x));
    const std::vector<double> weights = weights_of(r, across[v]);
    Tensor moment = Tensor::Zero();
    Vector aside = Vector::Zero();
    for (std::size_t k = 0; k < weights.size(); ++k) {
      aside += weights[k] * r[k];
      const Vector whole = mesh_->cell_centre[cells[v][k]] - x;
      moment += weights[k] * whole * whole.transpose();
      cells_of_vertex_.parts.push_back({cells[v][k], weights[k]});
    }
    places_.push_back(x + aside);
    around_vertex_.push_back(mirrored(moment, across[v]) - aside * aside.transpose());
    cells_of_vertex_.offset.push_back(cells_of_vertex_.parts.size());
  }
}

void VertexMeans::weigh_vertices(const std::vector<Index>& vertex_of_point) {
  for (const Index c : cells_) {
    std::vector<Vector> r;
    for (const Index p : mesh_->points_of_cell(c)) r.push_back(places_[vertex_of_point[p]] - mesh_->cell_centre[c]);
    const std::vector<double> weights = weights_of(r, {});
    std::size_t k = 0;
    for (const Index p : mesh_->points_of_cell(c))
      vertices_of_cell_.parts.push_back({vertex_of_point[p], weights[k++]});
    vertices_of_cell_.offset.push_back(vertices_of_cell_.parts.size());
  }
}

VertexMeans::Parts VertexMeans::Parts::transposed(std::size_t n_columns) const {
  Parts result;
  result.offset.assign(n_columns + 1, 0);
  for (const Part& part : parts) ++result.offset[part.of + 1];
  for (std::size_t i = 0; i < n_columns; ++i) result.offset[i + 1] += result.offset[i];
  result.parts.resize(parts.size());
  std::vector<std::size_t> next(result.offset.begin(), result.offset.end() - 1);
  for (std::size_t i = 0; i + 1 < offset.size(); ++i)
    for (std::size_t k = offset[i]; k < offset[i + 1]; ++k)
      result.parts[next[parts[k].of]++] = {static_cast<Index>(i), parts[k].weight};
  return result;
}

template <class Value>
double VertexMeans::Parts::row(Index i, const Value& value) const {
  double sum = 0.0;
  for (std::size_t k = offset[i]; k < offset[i + 1]; ++k) sum += parts[k].weight * value(parts[k].of);
  return sum;
}

CellField<double> VertexMeans::of(const CellField<double>& v) const {
  CellField<double> mean = v;
  std::vector<double> at_vertex(places_.size());
  parallel_for(count_of(at_vertex),
               [&](Index i) { at_vertex[i] = cells_of_vertex_.row(i, [&](Index c) { return v[c]; }); });
  parallel_for(count_of(cells_), [&](Index i) {
    mean[cells_[i]] = vertices_of_cell_.row(i, [&](Index vertex) { return at_vertex[vertex]; });
  });
  return mean;
}

CellField<double> VertexMeans::spread(const CellField<double>& v) const {
  CellField<double> sum = v;
  std::vector<double> at_vertex(places_.size());
  parallel_for(count_of(at_vertex),
               [&](Index i) { at_vertex[i] = vertices_transposed_.row(i, [&](Index k) { return v[cells_[k]]; }); });
  parallel_for(mesh_->n_cells(), [&](Index c) {
    const double own = is_averaged_[c] != 0 ? 0.0 : v[c];
    sum[c] = own + cells_of_vertex_transposed_.row(c, [&](Index vertex) { return at_vertex[vertex]; });
  });
  return sum;
}

Tensor VertexMeans::covariance(std::size_t i) const {
  Tensor sum = Tensor::Zero();
  for (std::size_t k = vertices_of_cell_.offset[i]; k < vertices_of_cell_.offset[i + 1]; ++k) {
    const auto [vertex, weight] = vertices_of_cell_.parts[k];
    const Vector r = places_[vertex] - mesh_->cell_centre[cells_[i]];
    sum += weight * (r * r.transpose() + around_vertex_[vertex]);
  }
  return sum;
}

}  // namespace pfdm
