#include "solver/fracture/cells/finite_cells.h"

#include "physics/elasticity/plane_stress.h"
#include "physics/materials/biot_stress.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_thickness = 1e-4;  // of a sheet, over that at rest: laws of principal stretches end at 0
constexpr double closing_range = 0.02;    // of J below 1, over which the faces of a cell become those of a closed crack

PotentialAt difference(const PotentialAt& a, const PotentialAt& b) {
  return {a.energy - b.energy, a.stress - b.stress, a.tangent - b.tangent};
}

PotentialAt sum(double w_a, const PotentialAt& a, double w_b, const PotentialAt& b) {
  return {w_a * a.energy + w_b * b.energy, w_a * a.stress + w_b * b.stress, w_a * a.tangent + w_b * b.tangent};
}

}  // namespace

FiniteCells::FiniteCells(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {
  if (!model.is_finite_strain()) return;
  using Kind = BoundaryCondition::Kind;
  for (const BoundaryCondition& on : model.boundary)
    if (on.kind == Kind::plane || on.kind == Kind::plane_stress) {
      plane_normal_ = mesh.face_area[mesh.patch(on.patch).first_face].normalized();
      if (on.kind == Kind::plane_stress) across_ = plane_normal_;
    }
  const std::size_t n = mesh.n_cells();
  material_ = CellField<const HyperelasticMaterial*>(n, nullptr);
  split_ = CellField<const FiniteSplit*>(n, &finite_split("none"));
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    material_[c] = dynamic_cast<const HyperelasticMaterial*>(region.material.get());
    if (!region.damageable) continue;
    split_[c] = &finite_split(model.split_of(region).name());
  }
}

// J - 1 = `change` is that of the cell, as its pressure has it, and H its mean gradient. What the faces add to W_m of H
// (beside_mean and CellMechanics::energy) contains what J of the cell differs by from det F.
FiniteCells::Parts FiniteCells::parts(Index cell, const Tensor& H, double change) const {
  const HyperelasticMaterial& material = *material_[cell];
  Parts parts{.moderate = material.moderate_potential(H), .network = network_potential(material, H)};
  const bool may_differ = !split_[cell]->driven_by_compression;
  if (may_differ) parts.compression = material.moderate_compression(H);
  if (material.pressure_modulus() > 0.0)
    parts.pressure = difference(material.potential(H, change), material.moderate_potential(H, change));
  parts.is_compressed = may_differ && change < 0.0;
  return parts;
}

FiniteCells::Parts FiniteCells::parts(Index cell, const CellMechanics& mechanics, const Tensor& H) const {
  const bool is_swept = mechanics.volume_change.size() > 0 && has_pressure(cell);
  if (!is_swept) return parts(cell, H, volume_change(H));
  return parts(cell, H, free_deformation(cell, mechanics).elastic_change(mechanics.volume_change[cell]));
}

PotentialAt FiniteCells::damaged(Index cell, const Parts& at, const FiniteShares& by, double g) const {
  const PotentialAt degraded = sum(by.moderate.value, at.moderate, by.network.value, at.network);
  PotentialAt relaxed = sum(1.0, degraded, by.pressure.value, at.pressure);
  if (!keeps(cell, at)) return relaxed;
  return sum(1.0, relaxed, 1.0, sum(1.0 - g, at.compression, 1.0 - by.pressure.value, at.pressure));
}

FreeDeformation FiniteCells::free_deformation(Index cell, const CellMechanics& mechanics) {
  const CellField<Mandel>& eigenstrain = mechanics.eigenstrain;
  return eigenstrain.size() > 0 ? FreeDeformation(to_tensor(eigenstrain[cell])) : FreeDeformation();
}

// F_e - 1; of a plate within its plane.
Tensor FiniteCells::elastic(const Tensor& H, const FreeDeformation& free) const {
  const Tensor elastic = free.elastic(H);
  return is_plane_stress() ? (elastic - across_.dot(elastic * across_) * across_ * across_.transpose()).eval()
                           : elastic;
}

// In the stiffness of faces J*/J^2 replaces 1/J_e^2 (FiniteLaw::swelling), and lambda/J* replaces lambda.
FiniteLaw FiniteCells::law(Index cell, const Tensor& H, double g, double closure, const FreeDeformation& free) const {
  const Tensor F_e = elastic(H, free);
  FiniteLaw law = is_plane_stress() ? plane_stress_law(cell, F_e, g) : solid_law(cell, F_e, g, closure);
  if (free.is_none()) return law;
  const double mean = free.inverse().squaredNorm() / 3.0;  // of m.m
  law.stress = free.stress(law.stress);
  law.A = free.tangent(law.A);
  law.free_share = free.volume() * mean;
  law.face.mu *= law.free_share;
  law.face.lambda /= free.volume();
  law.swelling /= mean;
  law.free_change = free.change();
  return law;
}

FiniteLaw FiniteCells::solid_law(Index cell, const Tensor& H, double g, double closure) const {
  const HyperelasticMaterial& material = *material_[cell];
  const bool keeps = keeps_compression(cell);
  const FiniteShares by = finite_shares(*material_[cell], g);
  const double w = by.moderate.value / g;
  const PotentialAt moderate = material.moderate_potential(H);
  PotentialAt degraded{0.0, by.moderate.value * moderate.stress, by.moderate.value * moderate.tangent};
  if (w < 1.0) degraded = sum(1.0, degraded, by.network.value, network_potential(material, H));
  FiniteLaw law{.stress = degraded.stress, .A = degraded.tangent, .face = {}};
  if (keeps && g < 1.0) {
    const PotentialAt kept = material.moderate_compression(H);
    law.stress += (1.0 - g) * kept.stress;
    law.A += (1.0 - g) * kept.tangent;
  }
  IsotropicElasticity sound = material.elasticity();
  if (material.pressure_modulus() > 0.0) {
    law.pressure = &material;
    law.open = by.pressure.value;
    law.closed = keeps ? 1.0 : law.open;
    sound.lambda -= material.pressure_modulus();
  }
  sound.mu = w * material.shear_modulus(Tensor::Identity() + H, moderate.tangent, sound.lambda) + (1.0 - w) * sound.mu;
  law.face = {.lambda = w * g * sound.lambda, .mu = g * sound.mu};
  law.swelling = w;
  if (keeps) law.face.lambda += closure * (1.0 - g) * sound.bulk_modulus();
  return law;
}

// The stiffness of the faces is that of an incompressible sheet at F = 1, (3 mu c c^T + mu)/h, c being the cofactor
// within the plane.
FiniteLaw FiniteCells::plane_stress_law(Index cell, const Tensor& H, double g) const {
  const FiniteShares by = finite_shares(*material_[cell], g);
  const Tensor nn = across_ * across_.transpose();
  const PotentialAt at = damaged(cell, parts(cell, thinned(cell, H, g)), by, g);
  const IsotropicElasticity sound = plane_stress(material_[cell]->elasticity());
  const double w = by.moderate.value / g;
  FiniteLaw law{.stress = at.stress, .A = at.tangent, .face = {.lambda = 0.0, .mu = g * sound.mu}};
  law.swelling = w * (sound.lambda + sound.mu) / sound.mu;
  const Components pull = at.tangent * to_components(nn), thin = at.tangent.transpose() * to_components(nn);
  const double stiffness = contract(nn, from_components(pull));
  if (std::abs(contract(nn, at.stress)) <= 1e-6 * g * sound.mu) law.A -= pull * thin.transpose() / stiffness;
  return law;
}

// With the stretch across a plate at which there is no stress across it, or the least thickness: of a network, which
// pulls at any, and of cells turned inside out.
Tensor FiniteCells::thinned(Index cell, const Tensor& H, double g) const {
  if (!is_plane_stress()) return H;
  constexpr Index most_steps = 80;
  constexpr double rounding = 1e-15;
  const FiniteShares by = finite_shares(*material_[cell], g);
  const Tensor nn = across_ * across_.transpose();
  double strain = 0.0;
  for (Index k = 0; k < most_steps; ++k) {
    const PotentialAt at = damaged(cell, parts(cell, H + strain * nn), by, g);
    const double stiffness = contract(nn, from_components(at.tangent * to_components(nn)));
    const double next = std::max(strain - contract(nn, at.stress) / stiffness, least_thickness - 1.0);
    const bool there = std::abs(next - strain) <= rounding * (std::abs(strain) + H.norm());
    strain = next;
    if (there) break;
  }
  return H + strain * nn;
}

Tensor FiniteCells::thinned_elastic(Index cell, const CellMechanics& mechanics, double g) const {
  return thinned(cell, elastic(mechanics.gradient[cell], free_deformation(cell, mechanics)), g);
}

Tensor FiniteCells::thinned(Index cell, const CellMechanics& mechanics, double g) const {
  if (!is_plane_stress()) return mechanics.gradient[cell];
  return free_deformation(cell, mechanics).total(thinned_elastic(cell, mechanics, g));
}

double FiniteCells::closure(Index cell, const CellMechanics& mechanics) const {
  if (!keeps_compression(cell)) return 0.0;
  const Tensor F_e = elastic(mechanics.gradient[cell], free_deformation(cell, mechanics));
  return std::clamp(-volume_change(F_e) / closing_range, 0.0, 1.0);
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
  const Tensor& P = is_pressed ? mechanics.moderate_stress[cell] : mechanics.stress[cell];
  const FreeDeformation free = free_deformation(cell, mechanics);
  const Tensor elastic_stress = damaged(cell, moderate, finite_shares(*material_[cell], g), g).stress;
  Tensor excess = P - free.stress(elastic_stress);
  excess -= plane_normal_.dot(excess * plane_normal_) * plane_normal_ * plane_normal_.transpose();  // no faces there
  const Tensor F_e = Tensor::Identity() + elastic(mechanics.gradient[cell], free);
  return 0.5 * contract(excess, stretch_part(F_e) * free.stretch());
}

// The moments of tractions in cells without a pressure count in the account alone: the rotation of the whole body is in
// them, which cannot drive the damage of a cell.
FiniteEnergies FiniteCells::energies(Index cell, const CellMechanics& mechanics, double g) const {
  const Parts at = parts(cell, mechanics, thinned_elastic(cell, mechanics, g));
  const double volume = free_deformation(cell, mechanics).volume();
  const double V = mesh_.cell_volume[cell],
               moments = mechanics.moment_work.size() > 0 ? mechanics.moment_work[cell] : 0.0;
  const bool drive = has_pressure(cell) || !model_.in_cell(mesh_, cell).damageable;
  return {.moderate = volume * at.moderate.energy,
          .network = volume * at.network.energy,
          .pressure = volume * at.pressure.energy,
          .compression = volume * at.compression.energy,
          .is_compressed = at.is_compressed,
          .faces = (mechanics.energy[cell] + (drive ? moments : 0.0)) / V + beside_mean(cell, mechanics, at, g),
          .of = g,
          .moments = drive ? 0.0 : moments / V};
}

double FiniteCells::stored_energy(Index cell, const FiniteEnergies& at, double g) const {
  const FiniteShares by = finite_shares(*material_[cell], g);
  const bool whole = keeps(cell, at);
  const double kept = whole ? (1.0 - g) * at.compression : 0.0;
  const double density = by.moderate.value * at.moderate + by.network.value * at.network + kept +
                         (whole ? 1.0 : by.pressure.value) * at.pressure + at.faces + at.moments;
  return mesh_.cell_volume[cell] * density;
}

// W_c is taken off where compression does not drive, as it is degraded: by 1 with a split that keeps it, else by the
// share of W_m. The energy of the faces is taken as proportional to g where nothing is kept. In a cell that is driven
// less by compression it must not end at J = 1: its damage would go to and fro.
DrivingAt FiniteCells::driving_energy(Index cell, const FiniteEnergies& at, double g) const {
  const FiniteShares by = finite_shares(*material_[cell], g);
  const bool whole = keeps(cell, at);
  const FiniteShare off = whole ? FiniteShare{.value = g, .slope = 1.0} : by.moderate;
  const double pressure = at.is_compressed ? 0.0 : at.pressure, faces = whole ? 0.0 : at.faces / at.of;
  const double value = by.moderate.slope * at.moderate + by.network.slope * at.network - off.slope * at.compression +
                       by.pressure.slope * pressure + faces;
  if (value <= 0.0) return {};
  return {.value = value,
          .slope = by.moderate.curvature * at.moderate + by.network.curvature * at.network -
                   off.curvature * at.compression + by.pressure.curvature * pressure};
}

Tensor FiniteCells::undamaged_biot_stress(Index cell, const CellMechanics& mechanics, double g) const {
  const Tensor H = thinned_elastic(cell, mechanics, g);
  const Parts at = parts(cell, mechanics, H);
  const FiniteShares by = finite_shares(*material_[cell], g);
  const PotentialAt whole = sum(by.moderate.value / g, at.moderate, by.network.value / g, at.network);
  return biot_stress(H, whole.stress + (keeps(cell, at) ? 1.0 : by.pressure.value / g) * at.pressure.stress);
}

// The deformation gradient for the Cauchy stress. A broken sheet, a network, has next to no thickness: it counts as
// thick as a sound one at the same stretch, and where it is turned inside out as thick as at rest.
Tensor FiniteCells::true_deformation(Index cell, const Tensor& H, double g) const {
  Tensor thin = Tensor::Identity() + thinned(cell, H, g);
  if (!is_plane_stress()) return thin;
  const Tensor nn = across_ * across_.transpose();
  const bool is_turned = volume_change(H - contract(nn, H) * nn) <= -1.0;
  const double sound = is_turned ? 1.0 : 1.0 + contract(nn, thinned(cell, H, 1.0));
  return thin + std::max(sound - contract(nn, thin), 0.0) * nn;
}

// First Piola-Kirchhoff.
Tensor FiniteCells::traction_stress(Index cell, const CellMechanics& mechanics, double g,
                                    const Vector& plane_normal) const {
  const Tensor& P = mechanics.stress[cell];
  if (plane_normal.isZero()) return P;
  const Tensor across = plane_normal * plane_normal.transpose();
  const Parts at = parts(cell, mechanics, thinned_elastic(cell, mechanics, g));
  const Tensor of_law =
      free_deformation(cell, mechanics).stress(damaged(cell, at, finite_shares(*material_[cell], g), g).stress);
  return P + across * (of_law - P) * across;
}

// The energy of the faces is not one of F*.
Tensor FiniteCells::eigenstrain_moment(Index cell, const CellMechanics& mechanics, double g,
                                       const Vector& plane_normal) const {
  FiniteEnergies mean = energies(cell, mechanics, g);
  mean.faces = 0.0;
  const Tensor P = traction_stress(cell, mechanics, g, plane_normal);
  const double energy = stored_energy(cell, mean, g) / mesh_.cell_volume[cell];
  const Tensor slope = free_deformation(cell, mechanics).energy_slope(energy, P, thinned(cell, mechanics, g));
  return -mesh_.cell_volume[cell] * symmetric_part(slope);
}

Tensor FiniteCells::cauchy_stress(Index cell, const CellMechanics& mechanics, double g,
                                  const Vector& plane_normal) const {
  const Tensor P = traction_stress(cell, mechanics, g, plane_normal);
  const FreeDeformation free = free_deformation(cell, mechanics);
  const Tensor F = true_deformation(cell, elastic(mechanics.gradient[cell], free), g) * free.stretch();
  return symmetric_part(P * F.transpose() / F.determinant());
}

}  // namespace pfdm
