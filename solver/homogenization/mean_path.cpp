#include "solver/homogenization/mean_path.h"

#include "physics/error.h"
#include "solver/homogenization/box_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// The tensor with a 1 in this component, and in its twin.
Tensor with_component(std::size_t k) {
  const auto i = static_cast<int>(k);
  return to_tensor(mandel_factor(i) * Mandel::Unit(i));
}

Tensor prescribed_strain(const MeanPath& path, double t) {
  const std::array<double, 6> at = path.at(t);
  Tensor strain = Tensor::Zero();
  for (std::size_t k = 0; k < at.size(); ++k)
    if (!path.by_stress[k]) strain += at[k] * with_component(k);
  return strain;
}

}  // namespace

std::array<double, 6> MeanPath::at(double t) const {
  const double last = static_cast<double>(points.size());
  const double within = std::clamp(t, 0.0, last);
  const auto next = std::min(static_cast<std::size_t>(within), points.size() - 1);
  const double share = within - static_cast<double>(next);
  std::array<double, 6> value{};
  constexpr double rounding = 1e-12;  // where a path goes through zero it has to be zero
  for (std::size_t k = 0; k < value.size(); ++k) {
    const double from = next == 0 ? 0.0 : points[next - 1][k];
    value[k] = from + share * (points[next][k] - from);
    if (std::abs(value[k]) < rounding * std::abs(points[next][k] - from)) value[k] = 0.0;
  }
  return value;
}

IsotropicElasticity reuss_estimate(const Mesh& mesh, const CellField<IsotropicElasticity>& cells) {
  double volume = 0.0, bulk = 0.0, shear = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    volume += mesh.cell_volume[c];
    bulk += mesh.cell_volume[c] / cells[c].bulk_modulus();
    shear += mesh.cell_volume[c] / cells[c].mu;
  }
  const double K = volume / bulk, G = volume / shear;
  return {K - 2.0 * G / 3.0, G};
}

BoxMotion motion_along(const MeanPath& path, const Mesh& mesh, const Loading& loading,
                       const IsotropicElasticity& estimate) {
  if (loading.by_traction)
    throw InputError(fmt::format(
        "a path of mean strain or stress cannot be combined with the boundary condition \"{}\"", loading.name));
  const BoxSides sides = find_box_sides(mesh);
  BoxMotion motion{.size = sides.upper - sides.lower, .centre = sides.centre()};
  if (loading.repeats) {
    motion.periodic = match_opposite_sides(mesh, sides);
    motion.held = {{motion.periodic.front().face, Tensor::Identity()}};
  } else {
    for (const Index face : sides.all()) motion.held.push_back({face, Tensor::Identity()});
  }
  motion.displacement = [path, centre = sides.centre()](const Vector& x, double t) -> Vector {
    return prescribed_strain(path, t) * (x - centre);
  };
  for (std::size_t k = 0; k < path.by_stress.size(); ++k) {
    if (!path.by_stress[k]) continue;
    const double factor = mandel_factor(static_cast<int>(k));
    const Tensor direction = with_component(k) / with_component(k).norm();
    motion.free_strains.push_back({.direction = direction,
                                   .stress = [path, k, factor](double t) { return factor * path.at(t)[k]; },
                                   .modulus = contract(direction, stress(estimate, direction))});
  }
  return motion;
}

}  // namespace pfdm
