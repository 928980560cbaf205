#include "solver/fracture/finite_cells.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double broken = 1e-3;       // stiffness factor of a cell that no longer has to keep its orientation
constexpr double least_volume = 0.1;  // over that at the last linearisation

PotentialAt difference(const PotentialAt& a, const PotentialAt& b) {
  return {a.energy - b.energy, a.stress - b.stress, a.tangent - b.tangent};
}

// The expansion about H to second order.
PotentialAt expanded(const PotentialAt& at, const Tensor& change) {
  const Components by = to_components(change);
  const Tensor rise = from_components(at.tangent * by);
  return {at.energy + contract(at.stress + 0.5 * rise, change), at.stress + rise, at.tangent};
}

}  // namespace

FiniteCells::FiniteCells(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {
  if (!model.is_finite_strain()) return;
  const auto n = as_size(mesh.n_cells());
  material_ = CellField<const HyperelasticMaterial*>(n, nullptr);
  keeps_compression_ = CellField<char>(n, 0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    material_[c] = dynamic_cast<const HyperelasticMaterial*>(region.material.get());
    keeps_compression_[c] = region.damageable && model.split_of(region).name() != "none" ? 1 : 0;
  }
}

CellHistories FiniteCells::virgin_histories() const { return CellHistories::gradients_only(as_size(mesh_.n_cells())); }

FiniteCells::Parts FiniteCells::parts(Index cell, const Tensor& H) const {
  const PotentialAt whole = material_[cell]->potential(H);
  if (keeps_compression_[cell] == 0) return {whole, {}};
  const PotentialAt kept = material_[cell]->compression(H);
  return {difference(whole, kept), kept};
}

CellField<GradientStress> FiniteCells::linearised(const CellField<double>& g, const CellHistories& histories) const {
  CellField<GradientStress> law(as_size(mesh_.n_cells()));
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const Tensor H = histories.gradient(c);
    const auto [degraded, kept] = parts(c, H);
    const GradientTangent A = g[c] * degraded.tangent + kept.tangent;
    law[c] = {A, g[c] * degraded.stress + kept.stress - from_components(A * to_components(H))};
  });
  return law;
}

bool FiniteCells::follow(const CellField<Tensor>& gradients, const CellField<double>& g, const CellHistories& start,
                         CellHistories& histories) const {
  const double inverted = parallel_sum(mesh_.n_cells(), [&](Index c) {
    if (g[c] < broken) return 0.0;
    const double before = 1.0 + volume_change(histories.gradient(c)), now = 1.0 + volume_change(gradients[c]);
    return now > least_volume * before ? 0.0 : 1.0;
  });
  if (inverted > 0.0) return false;
  parallel_for(mesh_.n_cells(),
               [&](Index c) { histories.gradient(c) = g[c] < broken ? Tensor(start.gradient(c)) : gradients[c]; });
  return true;
}

// Also where the law itself has no value.
FiniteCells::Parts FiniteCells::extended(Index cell, const Tensor& H, double g, const CellHistories& histories) const {
  const Tensor about = histories.gradient(cell);
  const double least = least_volume * (1.0 + volume_change(about));
  if (g >= broken && 1.0 + volume_change(H) > least) return parts(cell, H);
  const Parts at = parts(cell, about);
  return {expanded(at.degraded, H - about), expanded(at.kept, H - about)};
}

double FiniteCells::stored_energy(Index cell, const CellMechanics& mechanics, double g,
                                  const CellHistories& histories) const {
  const Parts at = extended(cell, mechanics.gradient[cell], g, histories);
  return mesh_.cell_volume[cell] * (g * at.degraded.energy + at.kept.energy) + mechanics.energy[cell];
}

double FiniteCells::driving_energy(Index cell, const CellMechanics& mechanics, double g,
                                   const CellHistories& histories) const {
  const Parts at = extended(cell, mechanics.gradient[cell], g, histories);
  const double varying = at.kept.energy > 0.0 ? 0.0 : mechanics.energy[cell] / (g * mesh_.cell_volume[cell]);
  return std::max(at.degraded.energy + varying, 0.0);
}

Tensor FiniteCells::cauchy_stress(Index cell, const CellMechanics& mechanics, double g, const CellHistories& histories,
                                  const Vector& plane_normal) const {
  const Tensor& H = mechanics.gradient[cell];
  Tensor P = mechanics.stress[cell];
  if (!plane_normal.isZero()) {
    const Parts at = extended(cell, H, g, histories);
    const Tensor across = plane_normal * plane_normal.transpose();
    P += across * (g * at.degraded.stress + at.kept.stress - P) * across;
  }
  const Tensor F = Tensor::Identity() + H;
  return symmetric_part(P * F.transpose() / F.determinant());
}

}  // namespace pfdm
