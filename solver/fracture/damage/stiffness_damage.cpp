#include "solver/fracture/damage/stiffness_damage.h"

#include "solver/fracture/model/symmetry_planes.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

constexpr double longest = 1.5;     // reach of a mean over that across
constexpr double row_share = 0.85;  // of what the mean of a row of d = 1 has below 1: a growing crack costs Gc
constexpr double sharpness = 2.0;
constexpr int largest_power = 64;
constexpr int n_table = 64;  // of the table of a profile, up to one ell

// d at the distances i ell/n_table from a broken row: ds = ell dd/sqrt(alpha).
std::array<double, n_table + 1> profile(const CrackGeometry& crack) {
  constexpr int n = 20000;
  std::array<double, n_table + 1> d{};
  d[0] = 1.0;
  double s = 0.0;
  int next = 1;
  for (int i = 0; i < n && next <= n_table; ++i) {
    s += 1.0 / (n * std::sqrt(crack.alpha(1.0 - (i + 0.5) / n)));
    for (; next <= n_table && s * n_table >= next; ++next) d[next] = 1.0 - (i + 1.0) / n;
  }
  return d;
}

double at_distance(const std::array<double, n_table + 1>& d, double s) {
  const double place = std::clamp(s, 0.0, 1.0) * n_table;
  const auto below = static_cast<std::size_t>(std::min(place, n_table - 1.0));
  const double part = place - static_cast<double>(below);
  return (1.0 - part) * d[below] + part * d[below + 1];
}

// The thickness h of the cells that a mean is over [m], by which its places have the variance h^2/2; zero where they
// reach much farther in one direction than in another.
double thickness(const Tensor& covariance, const Vector& plane_normal) {
  const bool is_plane = !plane_normal.isZero();
  const double n = is_plane ? 2.0 : 3.0;
  const Tensor within = Tensor::Identity() - plane_normal * plane_normal.transpose();
  const Tensor C = within * covariance * within;
  const double mean = C.trace() / n;
  const Tensor uneven = C - mean * within;
  // Variances along the edges of a hexahedron `longest` times as long as wide, or as wide and thick.
  const double least = 1.0, most = longest * longest, middle = (most + (n - 1.0) * least) / n;
  const double allowed =
      ((most - middle) * (most - middle) + (n - 1.0) * (least - middle) * (least - middle)) / (middle * middle);
  return contract(uneven, uneven) > allowed * mean * mean ? 0.0 : std::sqrt(2.0 * mean);
}

bool may_be_averaged(const Mesh& mesh, const FractureModel& model, Index cell) {
  const RegionModel& region = model.in_cell(mesh, cell);
  return mesh.shape[cell] == CellShape::hexahedron && region.damageable && !region.material &&
         model.split_of(region).is_variational();
}

// The cells whose vertices have only cells around them that may be averaged, of one region, and no cohesive face.
std::vector<Index> cells_between(const Mesh& mesh, const FractureModel& model) {
  constexpr Index none = -1, mixed = -2;
  std::vector<Index> region(mesh.points.size(), none);
  const CellField<Vector> shift = damage_points(mesh, model);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const bool fits = may_be_averaged(mesh, model, c) && (shift.size() == 0 || shift[c].isZero());
    for (const Index p : mesh.points_of_cell(c)) {
      Index& there = region[p];
      there = fits && (there == none || there == mesh.region[c]) ? mesh.region[c] : mixed;
    }
  }
  for (const CohesiveSurface& surface : model.interfaces)
    for (const Index f : surface.faces)
      for (const Index p : mesh.points_of_face(f)) region[p] = mixed;
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (std::ranges::none_of(mesh.points_of_cell(c), [&](Index p) { return region[p] == mixed; })) cells.push_back(c);
  return cells;
}

double power(double x, int m) {
  double result = 1.0;
  for (; m > 0; m /= 2, x *= x)
    if (m % 2 == 1) result *= x;
  return result;
}

}  // namespace

StiffnessDamage::StiffnessDamage(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal)
    : means_(mesh, {}) {
  if (model.stiffness_by == StiffnessBy::cell) return;
  laws_ = CellField<Law>(mesh.n_cells());
  const VertexMeans all(mesh, cells_between(mesh, model));
  const std::array<double, n_table + 1> row = profile(*model.crack);
  std::vector<Index> cells;
  for (std::size_t i = 0; i < all.cells().size(); ++i) {
    const Index c = all.cells()[i];
    const double h = thickness(all.covariance(i), plane_normal), ell = model.in_cell(mesh, c).ell;
    if (h == 0.0 || h > ell) continue;
    cells.push_back(c);
    laws_[c] = {.broken = 1.0 - row_share * 0.5 * (1.0 - at_distance(row, h / ell)),
                .power = std::clamp(static_cast<int>(std::lround(sharpness * ell / h)), 2, largest_power)};
  }
  means_ = VertexMeans(mesh, std::move(cells));
}

StiffnessDamage::At StiffnessDamage::at(Index cell, double mean) const {
  if (!any() || laws_[cell].power == 0) return {.value = mean};
  const Law& law = laws_[cell];
  if (mean >= law.broken) return {.value = 1.0, .slope = 0.0};
  const double x = std::max(mean, 0.0) / law.broken, lost = 1.0 - law.broken;
  const double m = law.power, lower = power(x, law.power - 2);
  return {.value = mean + lost * lower * x * x,
          .slope = 1.0 + lost * m * lower * x / law.broken,
          .curvature = lost * m * (m - 1.0) * lower / (law.broken * law.broken)};
}

CellField<double> StiffnessDamage::of(const CellField<double>& d) const {
  CellField<double> D = means(d);
  parallel_for(count_of(means_.cells()), [&](Index i) {
    const Index c = means_.cells()[i];
    D[c] = at(c, D[c]).value;
  });
  return D;
}

}  // namespace pfdm
