#include "solver/fracture/finite_cells.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double closing_range = 0.02;  // of J below 1, over which the faces of a cell become those of a closed crack

PotentialAt difference(const PotentialAt& a, const PotentialAt& b) {
  return {a.energy - b.energy, a.stress - b.stress, a.tangent - b.tangent};
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

FiniteCells::Parts FiniteCells::parts(Index cell, const Tensor& H) const {
  const PotentialAt whole = material_[cell]->potential(H);
  if (keeps_compression_[cell] == 0) return {whole, {}};
  const PotentialAt kept = material_[cell]->compression(H);
  return {difference(whole, kept), kept};
}

FiniteLaw FiniteCells::law(Index cell, const Tensor& H, double g, double closure) const {
  const HyperelasticMaterial& material = *material_[cell];
  const bool keeps = keeps_compression_[cell] != 0;
  const PotentialAt whole = material.moderate_potential(H);
  FiniteLaw law{.stress = g * whole.stress, .A = g * whole.tangent, .face = {}};
  if (keeps && g < 1.0) {
    const PotentialAt kept = material.moderate_compression(H);
    law.stress += (1.0 - g) * kept.stress;
    law.A += (1.0 - g) * kept.tangent;
  }
  IsotropicElasticity sound = material.elasticity();
  if (material.pressure_modulus() > 0.0) {
    law.pressure = &material;
    law.open = g;
    law.closed = keeps ? 1.0 : g;
    sound.lambda -= material.pressure_modulus();
  }
  sound.mu = material.shear_modulus(Tensor::Identity() + H, whole.tangent, sound.lambda);
  const double K = (keeps ? g + closure * (1.0 - g) : g) * sound.bulk_modulus(), mu = g * sound.mu;
  law.face = {.lambda = K - 2.0 / 3.0 * mu, .mu = mu};
  return law;
}

double FiniteCells::closure(Index cell, const Tensor& H) const {
  return keeps_compression_[cell] == 0 ? 0.0 : std::clamp(-volume_change(H) / closing_range, 0.0, 1.0);
}

double FiniteCells::stored_energy(Index cell, const CellMechanics& mechanics, double g) const {
  const Parts at = parts(cell, mechanics.gradient[cell]);
  return mesh_.cell_volume[cell] * (g * at.degraded.energy + at.kept.energy) + mechanics.energy[cell];
}

double FiniteCells::driving_energy(Index cell, const CellMechanics& mechanics, double g) const {
  const Parts at = parts(cell, mechanics.gradient[cell]);
  const double varying = at.kept.energy > 0.0 ? 0.0 : mechanics.energy[cell] / (g * mesh_.cell_volume[cell]);
  return std::max(at.degraded.energy + varying, 0.0);
}

Tensor FiniteCells::cauchy_stress(Index cell, const CellMechanics& mechanics, double g,
                                  const Vector& plane_normal) const {
  const Tensor& H = mechanics.gradient[cell];
  Tensor P = mechanics.stress[cell];
  if (!plane_normal.isZero()) {
    const Parts at = parts(cell, H);
    const Tensor across = plane_normal * plane_normal.transpose();
    P += across * (g * at.degraded.stress + at.kept.stress - P) * across;
  }
  const Tensor F = Tensor::Identity() + H;
  return symmetric_part(P * F.transpose() / F.determinant());
}

}  // namespace pfdm
