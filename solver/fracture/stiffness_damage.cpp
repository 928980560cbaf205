#include "solver/fracture/stiffness_damage.h"

#include "solver/fracture/symmetry_planes.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

constexpr double longest = 1.5;  // over the thickness
constexpr double share = 0.85;   // of what the mean of a row of d = 1 has below 1: a growing crack costs Gc
constexpr double sharpness = 2.0;
constexpr int largest_power = 64;
constexpr int n_nodes = 64;  // of the table of a profile, up to one ell

// d at the distances i ell/n_nodes from a broken row: ds = ell dd/sqrt(alpha).
std::array<double, n_nodes + 1> profile(const CrackGeometry& crack) {
  constexpr int n = 20000;
  std::array<double, n_nodes + 1> d{};
  d[0] = 1.0;
  double s = 0.0;
  int next = 1;
  for (int i = 0; i < n && next <= n_nodes; ++i) {
    s += 1.0 / (n * std::sqrt(crack.alpha(1.0 - (i + 0.5) / n)));
    for (; next <= n_nodes && s * n_nodes >= next; ++next) d[as_size(next)] = 1.0 - (i + 1.0) / n;
  }
  return d;
}

double at_distance(const std::array<double, n_nodes + 1>& d, double s) {
  const double place = std::clamp(s, 0.0, 1.0) * n_nodes;
  const auto below = static_cast<std::size_t>(std::min(place, n_nodes - 1.0));
  const double part = place - static_cast<double>(below);
  return (1.0 - part) * d[below] + part * d[below + 1];
}

// Largest and least thickness of a hexahedron within the plane [m].
std::pair<double, double> thicknesses(const Mesh& mesh, Index cell, const Vector& plane_normal) {
  double least = 1e300, most = 0.0;
  for (const Index f : mesh.faces_of_cell(cell)) {
    const double area = mesh.face_area[f].norm(), h = mesh.cell_volume[cell] / area;
    if (std::abs(mesh.face_area[f].dot(plane_normal)) > 0.5 * area) continue;
    least = std::min(least, h);
    most = std::max(most, h);
  }
  return {least, most};
}

bool may_be_averaged(const Mesh& mesh, const FractureModel& model, Index cell) {
  const RegionModel& region = model.in_cell(mesh, cell);
  return mesh.shape[cell] == CellShape::hexahedron && region.damageable && !region.material &&
         model.split_of(region).is_variational();
}

// Number of cells of one region, which may be averaged, around each point; -1 where others are there too, or a
// cohesive face is.
std::vector<int> cells_around_points(const Mesh& mesh, const FractureModel& model) {
  constexpr int other = -1, none = -2;
  std::vector<int> around(mesh.points.size(), 0);
  std::vector<Index> region(mesh.points.size(), none);
  const CellField<Vector> shift = damage_points(mesh, model);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const bool fits = may_be_averaged(mesh, model, c) && (shift.size() == 0 || shift[c].isZero());
    for (const Index p : mesh.points_of_cell(c)) {
      const bool same = region[as_size(p)] == none || region[as_size(p)] == mesh.region[c];
      region[as_size(p)] = mesh.region[c];
      int& n = around[as_size(p)];
      n = fits && same && n != other ? n + 1 : other;
    }
  }
  for (const CohesiveSurface& surface : model.interfaces)
    for (const Index f : surface.faces)
      for (const Index p : mesh.points_of_face(f)) around[as_size(p)] = other;
  return around;
}

double power(double x, int m) {
  double result = 1.0;
  for (; m > 0; m /= 2, x *= x)
    if (m % 2 == 1) result *= x;
  return result;
}

}  // namespace

StiffnessDamage::StiffnessDamage(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal)
    : mesh_(mesh), number_(as_size(mesh.n_cells()), -1), vertex_of_point_(mesh.points.size(), -1) {
  if (model.stiffness_by == StiffnessBy::cell) return;
  const int full = plane_normal.isZero() ? 8 : 4;  // cells around a vertex within the body
  const std::vector<int> around = cells_around_points(mesh, model);
  const std::array<double, n_nodes + 1> row = profile(*model.crack);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto is_full = [&](Index p) { return around[as_size(p)] == full; };
    if (!std::ranges::all_of(mesh.points_of_cell(c), is_full)) continue;
    const auto [least, most] = thicknesses(mesh, c, plane_normal);
    const double ell = model.in_cell(mesh, c).ell;
    if (most > longest * least || most > ell) continue;
    const double h = 0.5 * (least + most);
    number_[c] = static_cast<Index>(averaged_.size());
    averaged_.push_back({.cell = c,
                         .broken = 1.0 - share * 0.5 * (1.0 - at_distance(row, h / ell)),
                         .power = std::clamp(static_cast<int>(std::lround(sharpness * ell / h)), 2, largest_power)});
  }
  list_vertices();
}

void StiffnessDamage::list_vertices() {
  Index n_vertices = 0;
  for (const Averaged& averaged : averaged_)
    for (const Index p : mesh_.points_of_cell(averaged.cell))
      if (vertex_of_point_[as_size(p)] < 0) vertex_of_point_[as_size(p)] = n_vertices++;
  vertex_offset_.assign(as_size(n_vertices) + 1, 0);
  const auto each = [&](const auto& act) {
    for (Index c = 0; c < mesh_.n_cells(); ++c)
      for (const Index p : mesh_.points_of_cell(c))
        if (const Index v = vertex_of_point_[as_size(p)]; v >= 0) act(v, c);
  };
  each([&](Index v, Index) { ++vertex_offset_[as_size(v) + 1]; });
  for (std::size_t v = 1; v < vertex_offset_.size(); ++v) vertex_offset_[v] += vertex_offset_[v - 1];
  cell_of_vertex_.resize(vertex_offset_.back());
  std::vector<std::size_t> next(vertex_offset_.begin(), vertex_offset_.end() - 1);
  each([&](Index v, Index c) { cell_of_vertex_[next[as_size(v)]++] = c; });
}

CellField<double> StiffnessDamage::means(const CellField<double>& v) const {
  CellField<double> mean = v;
  if (!any()) return mean;
  const auto n_vertices = static_cast<Index>(vertex_offset_.size()) - 1;
  std::vector<double> at_vertex(as_size(n_vertices));
  parallel_for(n_vertices, [&](Index i) {
    double sum = 0.0;
    const std::size_t begin = vertex_offset_[as_size(i)], end = vertex_offset_[as_size(i) + 1];
    for (std::size_t k = begin; k < end; ++k) sum += v[cell_of_vertex_[k]];
    at_vertex[as_size(i)] = sum / static_cast<double>(end - begin);
  });
  parallel_for(static_cast<Index>(averaged_.size()), [&](Index i) {
    const Index c = averaged_[as_size(i)].cell;
    double sum = 0.0;
    for (const Index p : mesh_.points_of_cell(c)) sum += at_vertex[as_size(vertex_of_point_[as_size(p)])];
    mean[c] = sum / static_cast<double>(mesh_.points_of_cell(c).size());
  });
  return mean;
}

CellField<double> StiffnessDamage::spread(const CellField<double>& v) const {
  CellField<double> sum = v;
  if (!any()) return sum;
  const auto n_vertices = static_cast<Index>(vertex_offset_.size()) - 1;
  std::vector<double> at_vertex(as_size(n_vertices));
  parallel_for(n_vertices, [&](Index i) {
    double all = 0.0;
    const std::size_t begin = vertex_offset_[as_size(i)], end = vertex_offset_[as_size(i) + 1];
    for (std::size_t k = begin; k < end; ++k)
      if (const Index c = cell_of_vertex_[k]; number_[c] >= 0)
        all += v[c] / static_cast<double>(mesh_.points_of_cell(c).size());
    at_vertex[as_size(i)] = all / static_cast<double>(end - begin);
  });
  parallel_for(mesh_.n_cells(), [&](Index c) {
    double all = number_[c] >= 0 ? 0.0 : v[c];
    for (const Index p : mesh_.points_of_cell(c))
      if (const Index vertex = vertex_of_point_[as_size(p)]; vertex >= 0) all += at_vertex[as_size(vertex)];
    sum[c] = all;
  });
  return sum;
}

StiffnessDamage::At StiffnessDamage::at(Index cell, double mean) const {
  if (number_[cell] < 0) return {.value = mean};
  const Averaged& averaged = averaged_[as_size(number_[cell])];
  if (mean >= averaged.broken) return {.value = 1.0, .slope = 0.0};
  const double x = std::max(mean, 0.0) / averaged.broken, lost = 1.0 - averaged.broken;
  const double m = averaged.power, lower = power(x, averaged.power - 2);
  return {.value = mean + lost * lower * x * x,
          .slope = 1.0 + lost * m * lower * x / averaged.broken,
          .curvature = lost * m * (m - 1.0) * lower / (averaged.broken * averaged.broken)};
}

CellField<double> StiffnessDamage::of(const CellField<double>& d) const {
  CellField<double> D = means(d);
  parallel_for(static_cast<Index>(averaged_.size()), [&](Index i) {
    const Index c = averaged_[as_size(i)].cell;
    D[c] = at(c, D[c]).value;
  });
  return D;
}

}  // namespace pfdm
