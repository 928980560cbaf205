#include "solver/fracture/finite_cells.h"

#include "physics/materials/biot_stress.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_modulus = 1e-9;  // of a pressure, over the undamaged one
constexpr double closing_range = 0.02;  // of J below 1, over which the faces of a cell become those of a closed crack

PotentialAt difference(const PotentialAt& a, const PotentialAt& b) {
  return {a.energy - b.energy, a.stress - b.stress, a.tangent - b.tangent};
}

// What is left of the volumetric energy c U of a material with a pressure, and its derivative by g.
struct Relaxed {
  double value = 1.0, slope = 1.0;
};
Relaxed relaxed(const HyperelasticMaterial& material, double g) {
  const double ratio = material.pressure_modulus() / (CellPressure::moderate_lambda * material.elasticity().mu);
  const double lost = 1.0 - g, by = 1.0 + ratio * lost * lost;
  return {g / by, (by + 2.0 * ratio * g * lost) / (by * by)};
}

// 1 in cells that have to keep their orientation, 0 in broken ones, over a decade of g.
double soundness(double g) {
  constexpr double broken = 3e-4, sound = 3e-3;
  const double x = std::clamp(std::log(g / broken) / std::log(sound / broken), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// What W becomes in broken cells, mu/2 (F:F - 3).
PotentialAt network(const HyperelasticMaterial& material, const Tensor& H) {
  const double mu = material.elasticity().mu;
  return {0.5 * mu * (2.0 * H.trace() + H.squaredNorm()), mu * (Tensor::Identity() + H),
          mu * GradientTangent::Identity()};
}

PotentialAt blend(double w, const PotentialAt& a, const PotentialAt& b) {
  return {w * a.energy + (1.0 - w) * b.energy, w * a.stress + (1.0 - w) * b.stress,
          w * a.tangent + (1.0 - w) * b.tangent};
}

// The degraded part with what broken cells have of it.
auto in_damage(const HyperelasticMaterial& material, const Tensor& H, double g, auto parts) {
  const double w = soundness(g);
  if (w == 1.0) return parts;
  const PotentialAt n = network(material, H);
  parts.degraded.energy += (1.0 - w) * (n.energy - parts.degraded.energy - parts.kept.energy);
  parts.degraded.stress += (1.0 - w) * (n.stress - parts.degraded.stress - parts.kept.stress);
  return parts;
}

// The part of c U that is degraded, over J >= 1 only if compression is kept.
PotentialAt of_pressure(const HyperelasticMaterial& material, const Tensor& H, bool keeps_compression) {
  if (!(material.pressure_modulus() > 0.0) || (keeps_compression && volume_change(H) < 0.0)) return {};
  return difference(material.potential(H), material.moderate_potential(H));
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
  const double w = soundness(g);
  PotentialAt whole = material.moderate_potential(H);
  if (w < 1.0) whole = blend(w, whole, network(material, H));
  FiniteLaw law{.stress = g * whole.stress, .A = g * whole.tangent, .face = {}};
  if (keeps && g < 1.0) {
    const PotentialAt kept = material.moderate_compression(H);
    law.stress += (1.0 - g) * kept.stress;
    law.A += (1.0 - g) * kept.tangent;
  }
  IsotropicElasticity sound = material.elasticity();
  if (material.pressure_modulus() > 0.0) {
    law.pressure = &material;
    law.open = std::max(w * relaxed(material, g).value, least_modulus);
    law.closed = keeps ? 1.0 : law.open;
    sound.lambda -= material.pressure_modulus();
  }
  sound.mu = material.shear_modulus(Tensor::Identity() + H, whole.tangent, sound.lambda);
  law.face = {.lambda = w * g * sound.lambda, .mu = g * sound.mu};
  if (keeps) law.face.lambda += closure * (1.0 - g) * sound.bulk_modulus();
  return law;
}

double FiniteCells::closure(Index cell, const Tensor& H) const {
  return keeps_compression_[cell] == 0 ? 0.0 : std::clamp(-volume_change(H) / closing_range, 0.0, 1.0);
}

double FiniteCells::stored_energy(Index cell, const CellMechanics& mechanics, double g) const {
  const Tensor& H = mechanics.gradient[cell];
  const Parts at = in_damage(*material_[cell], H, g, parts(cell, H));
  const double by_volume = of_pressure(*material_[cell], H, keeps_compression_[cell] != 0).energy;
  const double relaxation = (relaxed(*material_[cell], g).value - g) * by_volume;
  return mesh_.cell_volume[cell] * (g * at.degraded.energy + at.kept.energy + relaxation) + mechanics.energy[cell];
}

double FiniteCells::driving_energy(Index cell, const CellMechanics& mechanics, double g) const {
  const Tensor& H = mechanics.gradient[cell];
  const Parts at = in_damage(*material_[cell], H, g, parts(cell, H));
  const double by_volume = of_pressure(*material_[cell], H, keeps_compression_[cell] != 0).energy;
  const double relaxation = (relaxed(*material_[cell], g).slope - 1.0) * by_volume;
  const double varying = at.kept.energy > 0.0 ? 0.0 : mechanics.energy[cell] / (g * mesh_.cell_volume[cell]);
  return std::max(at.degraded.energy + relaxation + varying, 0.0);
}

Tensor FiniteCells::undamaged_biot_stress(Index cell, const CellMechanics& mechanics, double g) const {
  const HyperelasticMaterial& material = *material_[cell];
  const Tensor& H = mechanics.gradient[cell];
  const Parts at = in_damage(material, H, g, parts(cell, H));
  const Tensor by_volume = of_pressure(material, H, keeps_compression_[cell] != 0).stress;
  return biot_stress(H, at.degraded.stress + at.kept.stress + (relaxed(material, g).value / g - 1.0) * by_volume);
}

Tensor FiniteCells::cauchy_stress(Index cell, const CellMechanics& mechanics, double g,
                                  const Vector& plane_normal) const {
  const Tensor& H = mechanics.gradient[cell];
  Tensor P = mechanics.stress[cell];
  if (!plane_normal.isZero()) {
    const Parts at = in_damage(*material_[cell], H, g, parts(cell, H));
    const HyperelasticMaterial& material = *material_[cell];
    const Tensor by_volume = of_pressure(material, H, keeps_compression_[cell] != 0).stress;
    const Tensor whole = g * at.degraded.stress + at.kept.stress + (relaxed(material, g).value - g) * by_volume;
    const Tensor across = plane_normal * plane_normal.transpose();
    P += across * (whole - P) * across;
  }
  const Tensor F = Tensor::Identity() + H;
  return symmetric_part(P * F.transpose() / F.determinant());
}

}  // namespace pfdm
