#include "solver/fracture/spread_damage.h"

#include "physics/quantity_text.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pfdm {
namespace {

constexpr double even = 0.1;           // of DamageEquation::unevenness
constexpr double least_growth = 1e-3;  // of the damage of a cell, for it to count as growing

/// The cells that soften while their damage grows.
struct Softening {
  std::vector<Index> cells;
  double volume = 0.0;   // of them [m^3]
  double damaged = 0.0;  // of the cells with at least half of the largest damage [m^3]
  double largest = 0.0;  // damage [-]
};

Softening softening_cells(const FractureState& before, const FractureState& now, const Staggered& staggered) {
  const Mesh& mesh = staggered.mesh();
  Softening found;
  found.largest = parallel_max(mesh.n_cells(), [&](Index c) { return now.damage[c]; });
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (now.damage[c] > 0.5 * found.largest) found.damaged += mesh.cell_volume[c];
    const bool grows = now.damage[c] > before.damage[c] + least_growth;
    if (!grows || !staggered.damage_equation().softens(c, now.damage[c], now.driving_energy[c])) continue;
    found.cells.push_back(c);
    found.volume += mesh.cell_volume[c];
  }
  return found;
}

// The direction of the largest mean elastic strain of these cells: cracks are normal to it.
Vector direction_of_strain(const Softening& softening, const CellMechanics& mechanics, const Mesh& mesh) {
  Tensor mean = Tensor::Zero();
  for (const Index c : softening.cells) mean += mesh.cell_volume[c] / softening.volume * mechanics.elastic_strain(c);
  return Eigen::SelfAdjointEigenSolver<Tensor>(mean).eigenvectors().col(2);
}

// Damage that gathers at the end of the softening cells: a parabola 4 ell wide, twice as wide as a crack's profile.
CellField<double> gathered(const Softening& softening, const Vector& direction, const FractureModel& model,
                           const Mesh& mesh, const CellField<double>& damage) {
  constexpr double width = 4.0;  // over ell
  constexpr double share = 0.1;  // of what is left of the most damaged cell
  double end = -std::numeric_limits<double>::infinity();
  for (const Index c : softening.cells) end = std::max(end, direction.dot(mesh.cell_centre[c]));
  const double ell = model.in_cell(mesh, softening.cells.front()).ell;
  CellField<double> more = damage;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!model.in_cell(mesh, c).damageable) continue;
    const double at = 1.0 - std::abs(direction.dot(mesh.cell_centre[c]) - end) / (width * ell);
    if (at > 0.0) more[c] = std::min(1.0, damage[c] + share * (1.0 - softening.largest) * at * at);
  }
  return more;
}

}  // namespace

std::string SpreadDamage::remark(const FractureState& before, const FractureState& now, Staggered& staggered) {
  constexpr double rounding = 1e-8;  // of energies, and what equilibrium leaves of them
  constexpr double most = 0.99;      // damage, beyond which nothing is left to gather
  if (said_ || !staggered.has_reduced_energy()) return "";
  const Softening softening = softening_cells(before, now, staggered);
  if (softening.cells.empty() || softening.volume < 0.5 * softening.damaged || softening.largest > most) return "";
  if (staggered.damage_equation().unevenness(now.damage) > even) return "";
  const Vector direction =
      direction_of_strain(softening, staggered.momentum().balance().mechanics(now.displacement), staggered.mesh());
  FractureState trial = now;
  trial.damage = gathered(softening, direction, staggered.model(), staggered.mesh(), now.damage);
  const double with_bump = staggered.reduced_energy(std::move(trial));
  const double energy = staggered.reduced_energy(now);  // last: stiffness and fluxes are left as they belong to `now`
  if (!(with_bump < energy - rounding * std::abs(energy))) return "";
  said_ = true;
  return fmt::format(
      "load {:.6g}: damage of up to {:.2g} grows evenly over {}. The body softens, and this equilibrium is unstable: "
      "the energy falls where damage gathers in one place, as it does in a real body, which breaks there. Make one "
      "place weaker, or every cell a little different: fracture.perturbation = 0.01",
      now.load, softening.largest, quantity_text(softening.volume, "m^3", 3));
}

}  // namespace pfdm
