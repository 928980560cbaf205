#include "solver/fracture/finite_stop.h"

#include "physics/quantity_text.h"
#include "solver/momentum/finite_strain/finite_tractions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {

Vector principal_stretches(const Tensor& F) { return Eigen::JacobiSVD<Tensor>(F).singularValues(); }

constexpr double broken = 0.3;  // damage beyond which a cell may stretch as it likes

std::string most_distorted(const Mesh& mesh, const MomentumOperator& balance, const CellField<double>& damage) {
  Index worst = -1;
  double most = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector stretches = principal_stretches(balance.finite()->states().deformation()[c]);
    const double ratio = stretches[0] / std::max(stretches[2], 1e-300);
    if (damage[c] > broken || ratio <= most) continue;
    most = ratio, worst = c;
  }
  if (worst < 0) return fmt::format("The damage of all cells is above {}", broken);
  const Tensor& F = balance.finite()->states().deformation()[worst];
  const Vector stretches = principal_stretches(F), &x = mesh.cell_centre[worst];
  return fmt::format(
      "The cell at {} in region \"{}\" is distorted most: J = {:.3g}, principal stretches "
      "{:.3g}, {:.3g}, {:.3g}",
      point_text(x, 4), mesh.region_names[mesh.region[worst]], F.determinant(), stretches[0], stretches[1],
      stretches[2]);
}

// On a component that is free, half-way or at the end of the load; or a pressure.
bool has_tractions(const Mesh& mesh, const FractureModel& model) {
  return std::ranges::any_of(model.boundary, [&](const BoundaryCondition& on) {
    if (on.kind != BoundaryCondition::Kind::components) return false;
    if (on.pressure) return true;
    const Patch& patch = mesh.patch(on.patch);
    for (Index f = patch.first_face; on.value && f < patch.first_face + patch.n_faces; ++f)
      for (const double t : {0.5, 1.0}) {
        const Vector value = on.value(mesh.face_centre[f], t);
        for (std::size_t i = 0; i < 3; ++i)
          if (!on.displacement_prescribed[i] && value[i] != 0.0) return true;
      }
    return false;
  });
}

bool is_damageable(const FractureModel& model) {
  return std::ranges::any_of(model.regions, [](const RegionModel& region) { return region.damageable; });
}

}  // namespace

std::string finite_stop(const Mesh& mesh, const FractureModel& model, const StaggeredSettings& settings,
                        const MomentumOperator& balance, const CellField<double>& damage, const StepOutcome& outcome) {
  std::vector<std::string> advice;
  std::string rest = "no part of Newton's step lowers the unbalanced forces";
  if (outcome.residual <= settings.equilibrium_tolerance) {
    rest = fmt::format("its damage and energies still change after {} iterations", outcome.iterations);
    if (outcome.iterations >= settings.maximum_iterations)
      advice.emplace_back("more iterations (solver.maximum_iterations)");
  } else if (std::isfinite(outcome.residual)) {
    rest = fmt::format("the momentum balance is left with a residual of {:.2g}, solver.equilibrium_tolerance is {:.2g}",
                       outcome.residual, settings.equilibrium_tolerance);
    if (outcome.settled) advice.emplace_back("a larger solver.equilibrium_tolerance");
  }
  if (is_damageable(model)) advice.emplace_back("a smaller loading.minimum_increment where the damage jumps");
  advice.emplace_back("a finer mesh around that cell");
  advice.emplace_back("steps of another length (loading.maximum_increment)");
  if (has_tractions(mesh, model))
    advice.emplace_back("displacements in place of tractions, which may be more than the body can bear");
  return fmt::format(
      "{}. {}. What may help: {}. Where the body itself becomes unstable, as it buckles or a cavity opens, none of "
      "this does",
      rest, most_distorted(mesh, balance, damage), fmt::join(advice, "; "));
}

}  // namespace pfdm
