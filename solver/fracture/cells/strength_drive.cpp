#include "solver/fracture/cells/strength_drive.h"

#include "solver/parallel.h"

namespace pfdm {

StrengthDrive strength_drive(const Mesh& mesh, const FractureModel& model, const CellStiffness& stiffness,
                             const CellMechanics& mechanics, const FractureState& state,
                             const CellField<double>& psi_plus) {
  if (!model.has_strength()) return {};
  const std::size_t n = mesh.n_cells();
  StrengthDrive drive{.force = CellField<double>(n, 0.0), .closed = CellField<double>(n, 0.0)};
  parallel_for(mesh.n_cells(), [&](Index c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (!region.strength.is_chosen() || !region.damageable) return;
    const Tensor sigma = stiffness.undamaged_stress(c, mechanics, state);
    drive.force[c] = region.strength.force(sigma);
    if (!StrengthModel::opens(sigma)) drive.closed[c] = psi_plus[c];
  });
  return drive;
}

double strength_dissipation(const Mesh& mesh, const FractureModel& model, const StrengthDrive& from,
                            const StrengthDrive& to, const CellField<double>& d_from, const CellField<double>& d_to) {
  if (to.force.size() == 0) return 0.0;
  const auto mean = [](const CellField<double>& a, const CellField<double>& b, Index c) {
    return 0.5 * ((a.size() > 0 ? a[c] : 0.0) + b[c]);
  };
  return parallel_sum(mesh.n_cells(), [&](Index c) {
    if (d_from[c] == d_to[c]) return 0.0;
    const Degradation& degradation = model.degradation_of(model.in_cell(mesh, c));
    const double g_from = degradation.g(d_from[c]), g_to = degradation.g(d_to[c]);
    const double g_middle = degradation.g(0.5 * (d_from[c] + d_to[c]));
    const double integral = (d_to[c] - d_from[c]) * (g_from + 4.0 * g_middle + g_to) / 6.0;  // exact for a quadratic g
    const double lost = (1.0 - model.residual_stiffness) * (g_to - g_from);
    return -mesh.cell_volume[c] * (integral * mean(from.force, to.force, c) + lost * mean(from.closed, to.closed, c));
  });
}

}  // namespace pfdm
