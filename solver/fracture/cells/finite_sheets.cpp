#include "solver/fracture/cells/finite_sheets.h"

#include "physics/elasticity/plane_stress.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double least_thickness = 1e-4;  // over that at rest: laws of principal stretches end at 0

}  // namespace

FiniteSheets::FiniteSheets(const Mesh& mesh, const FractureModel& model) : FiniteCells(mesh, model) {
  for (const BoundaryCondition& on : model.boundary)
    if (on.kind == BoundaryCondition::Kind::plane_stress)
      across_ = mesh.face_area[mesh.patch(on.patch).first_face].normalized();
}

Tensor FiniteSheets::elastic(const Tensor& H, const FreeDeformation& free) const {
  const Tensor elastic = free.elastic(H);
  return elastic - across_.dot(elastic * across_) * across_ * across_.transpose();
}

// The stiffness of the faces is that of an incompressible sheet at F = 1, (3 mu c c^T + mu)/h, c being the cofactor
// within the plane.
FiniteLaw FiniteSheets::elastic_law(FinitePlace place, const Tensor& H, const Degraded& left) const {
  const Index cell = place.cell;
  const double g = left.g;
  const FiniteShares by = finite_shares(material(cell), g);
  const Tensor nn = across_ * across_.transpose();
  const PotentialAt at = damaged(cell, parts(place, thinned(place, H, left), left.closure), by, g);
  IsotropicElasticity whole = material(cell).elasticity();
  const double of_branches = histories().has(cell) ? histories().modulus(cell) : 0.0;
  whole.mu += of_branches;
  whole.lambda -= 2.0 / 3.0 * of_branches;
  const IsotropicElasticity sound = plane_stress(whole);
  const double w = by.moderate.value / g;
  FiniteLaw law{.stress = at.stress, .A = at.tangent, .face = {.lambda = 0.0, .mu = g * sound.mu}};
  law.swelling = w * (sound.lambda + sound.mu) / sound.mu;
  if (histories().has(cell)) law.memory = {.share = by.moderate.value, .lambda = 0.0};
  law.sound_share = sound.mu / material(cell).elasticity().mu;
  const Components pull = at.tangent * to_components(nn), thin = at.tangent.transpose() * to_components(nn);
  const double stiffness = contract(nn, from_components(pull));
  if (std::abs(contract(nn, at.stress)) <= 1e-6 * g * sound.mu) law.A -= pull * thin.transpose() / stiffness;
  return law;
}

// With the stretch across a plate at which there is no stress across it, or the least thickness: of a network, which
// pulls at any, and of cells turned inside out.
Tensor FiniteSheets::thinned(FinitePlace place, const Tensor& H, const Degraded& left) const {
  const Index cell = place.cell;
  const double g = left.g;
  constexpr Index most_steps = 80;
  constexpr double rounding = 1e-15;
  const FiniteShares by = finite_shares(material(cell), g);
  const Tensor nn = across_ * across_.transpose();
  double strain = 0.0;
  for (Index k = 0; k < most_steps; ++k) {
    const PotentialAt at = damaged(cell, parts(place, H + strain * nn, left.closure), by, g);
    const double stiffness = contract(nn, from_components(at.tangent * to_components(nn)));
    const double next = std::max(strain - contract(nn, at.stress) / stiffness, least_thickness - 1.0);
    const bool there = std::abs(next - strain) <= rounding * (std::abs(strain) + H.norm());
    strain = next;
    if (there) break;
  }
  return H + strain * nn;
}

Tensor FiniteSheets::thinned(Index cell, const CellMechanics& mechanics, const Degraded& left) const {
  return free_deformation(cell, mechanics).total(thinned_elastic(cell, mechanics, left));
}

// A broken sheet, a network, has next to no thickness: it counts as thick as a sound one at the same stretch, and where
// it is turned inside out as thick as at rest.
Tensor FiniteSheets::true_deformation(Index cell, const Tensor& H, const Degraded& left) const {
  const Tensor thin = Tensor::Identity() + thinned({cell}, H, left);
  const Tensor nn = across_ * across_.transpose();
  const bool is_turned = volume_change(H - contract(nn, H) * nn) <= -1.0;
  const double sound = is_turned ? 1.0 : 1.0 + contract(nn, thinned({cell}, H, Degraded{}));
  return thin + std::max(sound - contract(nn, thin), 0.0) * nn;
}

}  // namespace pfdm
