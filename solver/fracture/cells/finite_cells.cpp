#include "solver/fracture/cells/finite_cells.h"

#include "solver/fracture/cells/finite_sheets.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Shear stiffness of the faces of closed cracks over the bulk modulus (of W_m). Such a crack has no shear
// stiffness of its own. Where faces have none either, the displacements beside them are arbitrary, and the tractions
// turn with them: Newton's method does not end on prisms, tetrahedra and polyhedra (solver/fracture/staggered.md).
constexpr double slip_share = 1e-3;

PotentialAt difference(const PotentialAt& a, const PotentialAt& b) {
  return {a.energy - b.energy, a.stress - b.stress, a.tangent - b.tangent};
}

PotentialAt sum(double w_a, const PotentialAt& a, double w_b, const PotentialAt& b) {
  return {w_a * a.energy + w_b * b.energy, w_a * a.stress + w_b * b.stress, w_a * a.tangent + w_b * b.tangent};
}

// Of W_m [Pa].
double moderate_bulk_modulus(const HyperelasticMaterial& material) {
  return material.elasticity().bulk_modulus() - material.pressure_modulus();
}

CellField<const HyperelasticMaterial*> hyperelastic_of(const Mesh& mesh, const FractureModel& model) {
  CellField<const HyperelasticMaterial*> materials(mesh.n_cells(), nullptr);
  for (Index c = 0; c < materials.size(); ++c)
    materials[c] = dynamic_cast<const HyperelasticMaterial*>(model.in_cell(mesh, c).material.get());
  return materials;
}

}  // namespace

FiniteCells::FiniteCells(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh), model_(model), material_(hyperelastic_of(mesh, model)), histories_(mesh, material_, model) {
  using Kind = BoundaryCondition::Kind;
  for (const BoundaryCondition& on : model.boundary)
    if (on.kind == Kind::plane || on.kind == Kind::plane_stress)
      plane_normal_ = mesh.face_area[mesh.patch(on.patch).first_face].normalized();
  const std::size_t n = mesh.n_cells();
  split_ = CellField<const FiniteSplit*>(n, &finite_split("none"));
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (!region.damageable) continue;
    split_[c] = &finite_split(model.split_of(region).name());
  }
}

// J - 1 = `change` is that of the cell, as its pressure has it, and H its mean gradient. What the faces add to W_m of H
// (beside_mean and CellMechanics::energy) contains what J of the cell differs by from det F.
FiniteCells::Parts FiniteCells::parts(FinitePlace place, const Tensor& H, double change, double closure) const {
  const Index cell = place.cell;
  const HyperelasticMaterial& material = *material_[cell];
  Parts parts{.moderate = material.moderate_potential(H), .network = network_potential(material, H)};
  if (material.pressure_modulus() > 0.0)
    parts.pressure = difference(material.potential(H, change), material.moderate_potential(H, change));
  parts.branches = of_branches(place, H);
  if (split_[cell]->driven_by_compression) return parts;
  const bool keeps = keeps_compression(cell);
  parts.closure = keeps ? closure : (change < 0.0 ? 1.0 : 0.0);
  parts.taken = keeps ? closure : (volume_change(H) < 0.0 ? 1.0 : 0.0);
  if (parts.taken == 0.0) return parts;
  // A closed crack has no shear stiffness that would make two volumes of a cell agree: its pressure bears all.
  if (keeps && has_pressure(cell))
    parts.dilation = sum(moderate_bulk_modulus(material) / material.pressure_modulus(), parts.pressure, 0.0, {});
  else
    parts.dilation = material.moderate_dilation(H);
  return parts;
}

PotentialAt FiniteCells::of_branches(FinitePlace at, const Tensor& H) const {
  return histories_.has(at.cell) ? histories_.branches(at.cell).over(H, histories_.before(at)) : PotentialAt();
}

// J_e - 1: that of the pressure where one is found, else that of the mean gradient.
double FiniteCells::change_of(Index cell, const CellMechanics& mechanics, const Tensor& H) const {
  const bool is_swept = mechanics.volume_change.size() > 0 && has_pressure(cell);
  return is_swept ? free_deformation(cell, mechanics).elastic_change(mechanics.volume_change[cell]) : volume_change(H);
}

PotentialAt FiniteCells::damaged(Index cell, const Parts& at, const FiniteShares& by, double g) const {
  PotentialAt degraded = sum(by.moderate.value, at.moderate, by.network.value, at.network);
  if (histories_.has(cell)) degraded = sum(1.0, degraded, by.moderate.value, at.branches);
  PotentialAt relaxed = sum(1.0, degraded, by.pressure.value, at.pressure);
  const double kept = this->kept(cell, at);
  if (kept == 0.0) return relaxed;
  return sum(1.0, relaxed, kept, sum(1.0 - g, at.dilation, 1.0 - by.pressure.value, at.pressure));
}

FreeDeformation FiniteCells::free_deformation(Index cell, const CellMechanics& mechanics) {
  const CellField<Mandel>& eigenstrain = mechanics.eigenstrain;
  return eigenstrain.size() > 0 ? FreeDeformation(to_tensor(eigenstrain[cell])) : FreeDeformation();
}

// In the stiffness of faces J*/J^2 replaces 1/J_e^2 (FiniteLaw::swelling), and lambda/J* replaces lambda.
FiniteLaw FiniteCells::law(FinitePlace at, const Tensor& H, const Degraded& left, const FreeDeformation& free) const {
  const Tensor F_e = elastic(H, free);
  FiniteLaw law = elastic_law(at, F_e, left);
  if (free.is_none()) return law;
  const double mean = free.inverse().squaredNorm() / 3.0;  // of m.m
  law.stress = free.stress(law.stress);
  law.A = free.tangent(law.A);
  const double share = free.volume() * mean;
  law.sound_share *= share;
  law.memory.share *= share;
  law.memory.lambda /= free.volume() * share;
  law.memory.bulk /= free.volume();
  law.face.mu *= share;
  law.face.lambda /= free.volume();
  law.swelling /= mean;
  law.free_change = free.change();
  return law;
}

// What a change of strain and of the gaps meets of the branches in the step.
void FiniteCells::add_branches(FinitePlace at, const Tensor& H, const FiniteShares& by, FiniteLaw& law) const {
  if (!histories_.has(at.cell)) return;
  const HyperelasticMaterial& material = *material_[at.cell];
  const PotentialAt branches = of_branches(at, H);
  law.stress += by.moderate.value * branches.stress;
  law.A += by.moderate.value * branches.tangent;
  const double mu = histories_.modulus(at.cell), lambda = material.branch_ratio();
  law.face.mu += by.moderate.value * mu;
  law.face.lambda += by.moderate.value * lambda * mu;
  law.face.lambda += by.moderate.value * histories_.bulk_modulus(at.cell);
  law.memory = {.share = by.moderate.value, .lambda = lambda, .bulk = by.moderate.value};
  law.sound_share = 1.0 + mu / material.elasticity().mu;
  if (law.pressure == nullptr) return;
  law.pressure_modulus -= (lambda + 2.0 / 3.0) * mu;
  law.pressure_left = (lambda + 2.0 / 3.0) * histories_.volume_left(at.cell);
}

FiniteLaw FiniteCells::elastic_law(FinitePlace at, const Tensor& H, const Degraded& left) const {
  const Index cell = at.cell;
  const HyperelasticMaterial& material = *material_[cell];
  const double g = left.g, kept = keeps_compression(cell) ? left.closure : 0.0;
  const FiniteShares by = finite_shares(*material_[cell], g);
  const double w = by.moderate.value / g;
  const PotentialAt moderate = material.moderate_potential(H);
  PotentialAt degraded{0.0, by.moderate.value * moderate.stress, by.moderate.value * moderate.tangent};
  if (w < 1.0) degraded = sum(1.0, degraded, by.network.value, network_potential(material, H));
  FiniteLaw law{.stress = degraded.stress, .A = degraded.tangent, .face = {}};
  if (kept > 0.0 && g < 1.0 && !has_pressure(cell)) {
    const PotentialAt dilation = material.moderate_dilation(H);
    law.stress += kept * (1.0 - g) * dilation.stress;
    law.A += kept * (1.0 - g) * dilation.tangent;
  }
  IsotropicElasticity sound = material.elasticity();
  if (material.pressure_modulus() > 0.0) {
    law.pressure = &material;
    law.pressure_share = share_left(by.pressure.value, kept);
    law.pressure_modulus = material.pressure_modulus();
    law.pressure_kept = kept * (1.0 - g) * moderate_bulk_modulus(material);
    sound.lambda -= material.pressure_modulus();
  }
  sound.mu = w * material.shear_modulus(Tensor::Identity() + H, moderate.tangent, sound.lambda) + (1.0 - w) * sound.mu;
  law.face = {.lambda = w * g * sound.lambda, .mu = g * sound.mu};
  law.swelling = w;
  law.face.lambda += kept * (1.0 - g) * sound.bulk_modulus();
  law.face.mu += slip_share * kept * (1.0 - g) * sound.bulk_modulus();
  add_branches(at, H, by, law);
  return law;
}

void FiniteCells::advance(const CellMechanics& mechanics, const CellField<Degraded>& left, CellHistories& to) {
  if (mechanics.eigenstrain.size() > 0) free_volume_ = CellField<double>(mesh_.n_cells(), 1.0);
  parallel_for(count_of(mechanics.gradients_of_laws), [&](Index k) {
    const FinitePlace at = histories_.place(k);
    if (!histories_.has(at.cell)) return;
    const FreeDeformation free = free_deformation(at.cell, mechanics);
    histories_.advance(at, thinned(at, elastic(mechanics.gradients_of_laws[k], free), left[at.cell]), to);
    if (at.own >= 0) return;
    if (free_volume_.size() > 0) free_volume_[k] = free.volume();
    const bool has_volume = mechanics.volume_change.size() > 0;
    const double change = has_volume ? free.elastic_change(mechanics.volume_change[k]) : 0.0;
    histories_.advance_gaps(k, mechanics.gaps, change, to);
  });
}

std::unique_ptr<FiniteCells> make_finite_cells(const Mesh& mesh, const FractureModel& model) {
  if (model.is_plane_stress()) return std::make_unique<FiniteSheets>(mesh, model);
  return std::make_unique<FiniteCells>(mesh, model);
}

}  // namespace pfdm
