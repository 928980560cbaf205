#include "solver/momentum/solution/force_balance.h"

#include "mesh/bounding_box.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

double force_through(const Mesh& mesh, std::span<const Vector> on_faces, const CellField<Tensor>& stress) {
  double on_surface = 0.0;
  for (const Vector& force : on_faces) on_surface += force.norm();
  const auto inside = parallel_sum(mesh.n_cells(), [&](Index c) { return stress[c].norm() * mesh.cell_volume[c]; });
  const Box box = bounding_box(mesh.points);
  return std::max(0.5 * on_surface, inside / (box.high - box.low).maxCoeff());
}

double unbalanced_force(const MomentumSolver& momentum, double load, const std::vector<Vector>& displacement) {
  const std::vector<Vector> rest = momentum.unbalanced_forces(load, displacement);
  return parallel_sum(momentum.n_nodes(), [&](Index i) { return rest[i].norm(); });
}

bool any_stress_stays(const CellField<Tensor>& stress, const CellField<Tensor>& with_smaller_tolerances) {
  constexpr double is_less = 0.5, by_chance = 1e-3;  // share of the cells
  const auto stay = parallel_sum(stress.size(), [&](Index c) {
    return with_smaller_tolerances[c].norm() > is_less * stress[c].norm() ? 1.0 : 0.0;
  });
  return stay > by_chance * static_cast<double>(stress.size());
}

double needed_tightening(double imbalance) {
  constexpr double margin = 0.3;
  return std::pow(10.0, std::floor(std::log10(margin * bearable_imbalance / imbalance)));
}

}  // namespace pfdm
