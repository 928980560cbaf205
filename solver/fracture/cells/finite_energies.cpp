// Energies and stresses of the cells at finite strain (finite_cells.h).

#include "physics/materials/biot_stress.h"
#include "solver/fracture/cells/degraded_heat.h"
#include "solver/fracture/cells/finite_cells.h"

#include <algorithm>

namespace pfdm {

// What a stress of the tractions is beyond that of the mean gradient; zero across a plane mesh, which has no faces
// there.
Tensor FiniteCells::beside_law(Index cell, const CellMechanics& mechanics, const Parts& at, const Tensor& P,
                               double g) const {
  const Tensor elastic_stress = damaged(cell, at, finite_shares(*material_[cell], g), g).stress;
  const Tensor excess = P - free_deformation(cell, mechanics).stress(elastic_stress);
  return excess - plane_normal_.dot(excess * plane_normal_) * plane_normal_ * plane_normal_.transpose();
}

// Half the work of what the tractions' stress is beyond that of the mean gradient, of cells with a pressure, and of all
// cells of a body with eigenstrains, whose stress may vary much within thin cells around what does not fit [J/m^3]:
// 1/2 (P - P(H)):(F_e - R) F*, R being the rotation in F_e. In bonded layers that are a few cells thick it is 1 to 5 %
// of the energy. Of undamageable regions: among the cells along a crack it would drive damage, and cracks grew at
// forces that were 6 % lower.
double FiniteCells::beside_mean(Index cell, const CellMechanics& mechanics, const Parts& at, double g) const {
  const bool is_pressed = mechanics.moderate_stress.size() > 0 && has_pressure(cell);
  if (!is_pressed && mechanics.eigenstrain.size() == 0) return 0.0;
  if (model_.in_cell(mesh_, cell).damageable) return 0.0;
  Parts moderate = at;
  moderate.pressure = {};
  const FreeDeformation free = free_deformation(cell, mechanics);
  const Tensor excess =
      beside_law(cell, mechanics, moderate, is_pressed ? mechanics.moderate_stress[cell] : mechanics.stress[cell], g);
  const Tensor F_e = Tensor::Identity() + elastic(mechanics.gradient[cell], free);
  return 0.5 * contract(excess, stretch_part(F_e) * free.stretch());
}

double FiniteCells::dissipation(Index cell, const CellHistories& from, double g_from, const CellHistories& to,
                                double g_to) const {
  if (!histories_.has(cell)) return 0.0;
  const double left_from = finite_shares(*material_[cell], g_from).moderate.value,
               left_to = finite_shares(*material_[cell], g_to).moderate.value;
  const double volume = mesh_.cell_volume[cell] * (free_volume_.size() > 0 ? free_volume_[cell] : 1.0);
  return volume * degraded_heat(left_from, histories_.energy(cell, from), left_to, histories_.energy(cell, to));
}

// The moments of tractions in cells without a pressure count in the account alone: the rotation of the whole body is in
// them, which cannot drive the damage of a cell.
FiniteEnergies FiniteCells::energies(Index cell, const CellMechanics& mechanics, const Degraded& left,
                                     const CellHistories& now) const {
  const Parts at = parts(cell, mechanics, thinned_elastic(cell, mechanics, left), left.closure);
  const double g = left.g;
  const double V = mesh_.cell_volume[cell],
               moments = mechanics.moment_work.size() > 0 ? mechanics.moment_work[cell] : 0.0;
  const bool drive = has_pressure(cell) || !model_.in_cell(mesh_, cell).damageable;
  FiniteEnergies energies = mean_energies(cell, mechanics, at);
  energies.faces = (mechanics.energy[cell] + (drive ? moments : 0.0)) / V + beside_mean(cell, mechanics, at, g);
  energies.of = g;
  energies.moments = drive ? 0.0 : moments / V;
  if (!histories_.has(cell)) return energies;
  energies.locked = free_deformation(cell, mechanics).volume() * histories_.locked(cell, now);
  // A sheet that is torn fast is driven as the elastic one at the same stretches, and what only changes its volume as
  // without branches.
  const double sheared = energies.moderate + energies.branches;
  if (!energies.branches_drive && sheared > 0.0) energies.drive = std::clamp(energies.moderate / sheared, 0.0, 1.0);
  return energies;
}

FiniteEnergies FiniteCells::mean_energies(Index cell, const CellMechanics& mechanics, const Parts& at) const {
  const double volume = free_deformation(cell, mechanics).volume();
  return {.moderate = volume * at.moderate.energy,
          .network = volume * at.network.energy,
          .pressure = volume * at.pressure.energy,
          .branches = volume * at.branches.energy,
          .branches_drive = material_[cell]->drive() == PronyDrive::stored,
          .dilation = volume * at.dilation.energy,
          .taken = at.taken,
          .closure = at.closure};
}

double FiniteCells::stored_energy(Index cell, const FiniteEnergies& at, double g) const {
  const FiniteShares by = finite_shares(*material_[cell], g);
  const double kept = this->kept(cell, at);
  const double density = by.moderate.value * (at.moderate + at.branches + at.locked) + by.network.value * at.network +
                         kept * (1.0 - g) * at.dilation + share_left(by.pressure.value, kept) * at.pressure + at.faces +
                         at.moments;
  return mesh_.cell_volume[cell] * density;
}

// W_c is taken off where compression does not drive, as it is degraded: by 1 with a split that keeps it, else by the
// share of W_m. The energy of the faces is taken as proportional to g where nothing is kept. In a cell that is driven
// less by compression it must not end at J = 1: its damage would go to and fro.
DrivingAt FiniteCells::driving_energy(Index cell, const FiniteEnergies& at, double g) const {
  const FiniteShares by = finite_shares(*material_[cell], g);
  const double kept = this->kept(cell, at);
  const FiniteShare off = keeps_compression(cell) ? FiniteShare{.value = g, .slope = 1.0} : by.moderate;
  const double pressure = (1.0 - at.closure) * at.pressure, faces = (1.0 - kept) * at.drive * at.faces / at.of;
  const double moderate = at.moderate + (at.branches_drive ? at.branches : 0.0);
  const auto driving = [&](double whole_slope, double as_moderate) {
    return whole_slope - (1.0 - at.drive) * (whole_slope - as_moderate);
  };
  const FiniteShare& of_pressure = by.pressure;
  const FiniteShares::Slope& as_moderate = by.pressure_as_moderate;
  const double value = by.moderate.slope * moderate + by.network.slope * at.network -
                       off.slope * at.taken * at.dilation + driving(of_pressure.slope, as_moderate.slope) * pressure +
                       faces;
  if (value <= 0.0) return {};
  return {.value = value,
          .slope = by.moderate.curvature * moderate + by.network.curvature * at.network -
                   off.curvature * at.taken * at.dilation +
                   driving(of_pressure.curvature, as_moderate.curvature) * pressure};
}

Tensor FiniteCells::undamaged_biot_stress(Index cell, const CellMechanics& mechanics, const Degraded& left) const {
  const Tensor H = thinned_elastic(cell, mechanics, left);
  const Parts at = parts(cell, mechanics, H, left.closure);
  const double g = left.g;
  const FiniteShares by = finite_shares(*material_[cell], g);
  const double kept = this->kept(cell, at), share = by.pressure.value / g;
  const Tensor whole = (by.moderate.value * at.moderate.stress + by.network.value * at.network.stress) / g;
  return biot_stress(H, whole + share_left(share, kept) * at.pressure.stress);
}

// First Piola-Kirchhoff.
Tensor FiniteCells::traction_stress(Index cell, const CellMechanics& mechanics, const Degraded& left,
                                    const Vector& plane_normal) const {
  const Tensor& P = mechanics.stress[cell];
  if (plane_normal.isZero()) return P;
  const Tensor across = plane_normal * plane_normal.transpose();
  const Parts at = parts(cell, mechanics, thinned_elastic(cell, mechanics, left), left.closure);
  const double g = left.g;
  const Tensor of_law =
      free_deformation(cell, mechanics).stress(damaged(cell, at, finite_shares(*material_[cell], g), g).stress);
  return P + across * (of_law - P) * across;
}

// The energy of the faces is not one of F*.
Tensor FiniteCells::eigenstrain_moment(Index cell, const CellMechanics& mechanics, const Degraded& left,
                                       const Vector& plane_normal) const {
  const FiniteEnergies mean =
      mean_energies(cell, mechanics, parts(cell, mechanics, thinned_elastic(cell, mechanics, left), left.closure));
  const Tensor P = traction_stress(cell, mechanics, left, plane_normal);
  const double energy = stored_energy(cell, mean, left.g) / mesh_.cell_volume[cell];
  const Tensor slope = free_deformation(cell, mechanics).energy_slope(energy, P, thinned(cell, mechanics, left));
  return -mesh_.cell_volume[cell] * symmetric_part(slope);
}

Tensor FiniteCells::cauchy_stress(Index cell, const CellMechanics& mechanics, const Degraded& left,
                                  const Vector& plane_normal) const {
  const Tensor P = traction_stress(cell, mechanics, left, plane_normal);
  const FreeDeformation free = free_deformation(cell, mechanics);
  const Tensor F = true_deformation(cell, elastic(mechanics.gradient[cell], free), left) * free.stretch();
  return symmetric_part(P * F.transpose() / F.determinant());
}

// The tractions hold a closed crack. The volume of the mean gradient may have the other sign where the strain varies
// within a cell, and the crack would open and close for ever.
std::optional<double> FiniteCells::closing_change(Index cell, const CellMechanics& mechanics,
                                                  const Degraded& left) const {
  if (!keeps_compression(cell)) return {};
  const Tensor H = thinned_elastic(cell, mechanics, left), F = Tensor::Identity() + mechanics.gradient[cell];
  const double change = change_of(cell, mechanics, H);
  if (has_pressure(cell) || F.determinant() < least_volume) return change;  // or turned inside out
  const Tensor excess =
      beside_law(cell, mechanics, parts({cell}, H, change, left.closure), mechanics.stress[cell], left.g);
  const double K = share_left(left.g, left.closure) * material_[cell]->elasticity().bulk_modulus();
  return change + contract(excess, F) / (3.0 * K * F.determinant());
}

// Small changes store K/2 change^2; large ones, of cells that are distorted, would count for more than they store.
double FiniteCells::closing_energy(Index cell, double change, const Degraded& left) const {
  constexpr double most = 0.1;
  const double wrong = std::abs(left.closure - (change < 0.0 ? 1.0 : 0.0)), by = std::min(std::abs(change), most);
  const double K = wrong * (1.0 - left.g) * material_[cell]->elasticity().bulk_modulus();
  return 0.5 * K * by * by * mesh_.cell_volume[cell];
}

}  // namespace pfdm
