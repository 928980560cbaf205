#include "solver/momentum/small_strain/small_tractions.h"

#include "solver/momentum/faces/polyhedral_jump.h"
#include "solver/parallel.h"

namespace pfdm {

SmallTractions::SmallTractions(const FaceSkeleton& skeleton, CellReconstruction& cells,
                               const CellEigenstrain& eigenstrain)
    : FaceTractions(skeleton),
      cells_(cells),
      eigenstrain_(eigenstrain),
      jump_share_(jump_shares(skeleton.mesh, skeleton.unknowns)) {}

// A pressure carries what is beyond lambda_s; it hardly varies within a cell.
IsotropicPart SmallTractions::with_jump_modulus(Index cell, const IsotropicElasticity& part) const {
  IsotropicPart with{part, part};
  if (part.lambda <= 0.0) return with;
  with.jump.lambda = jump_share_[cell] * part.constrained_modulus() - 2.0 * part.mu;
  if (cells_.pressure().modulus(cell) > 0.0)
    with.jump.lambda = std::min(with.jump.lambda, CellPressure::moderate_lambda * part.mu);
  return with;
}

// Within the plane in plane stress: the stress does not depend on that across it.
void SmallTractions::extrapolate_eigenstrains() {
  eigenstrain_changes_.clear();
  if (!eigenstrain_.any() || !cells_.layers().any()) return;
  eigenstrain_changes_.assign(skeleton_.n_turns(), Tensor::Zero());
  const Tensor within =
      Tensor::Identity() - (is_plane_stress() ? 1.0 : 0.0) * plane_normal() * plane_normal().transpose();
  cells_.layers().extrapolate([&](std::size_t turn, Index cell, Index behind, double part) {
    eigenstrain_changes_[turn] = part * within * to_tensor(eigenstrain_[cell] - eigenstrain_[behind]) * within;
  });
}

void SmallTractions::finish_stress(Index c, const CellSums& sums, const Sweep& sweep, CellMechanics& result) const {
  const double volume = skeleton_.mesh.cell_volume[c];
  const Vector& normal = plane_normal();
  Tensor moment = sums.moment;
  result.stress[c] = symmetric_part((moment * skeleton_.closure[c]) / volume);
  if (!skeleton_.unknowns.is_axisymmetric()) {
    const Tensor across = stress_across(c, result.strain[c], sweep) * normal * normal.transpose();
    result.stress[c] += across;
    moment += volume * across;
  }
  if (!eigenstrain_.any()) return;
  result.traction_moment[c] = to_mandel(symmetric_part(moment));
  result.energy[c] -= 0.5 * result.traction_moment[c].dot(eigenstrain_[c]);
}

// The strain of a cell is the mean over its faces. Where lines of cells count it is theirs, as that of the tractions:
// nodes on the surfaces of layers move by other gradients than their cells have. Energies keep to the faces.
CellMechanics SmallTractions::mechanics(const std::vector<Vector>& u, bool with_gradient,
                                        const CellField<IsotropicElasticity>& part) const {
  const auto lease = sweep();
  find(u, *lease);
  FaceField<Vector> u_face = face_displacements(u, *lease);
  const FaceMoves moves{.skeleton = skeleton_, .sweep = *lease, .u = u, .u_face = u_face};
  const std::size_t n = skeleton_.mesh.n_cells();
  CellMechanics result{.strain = CellField<Tensor>(n),
                       .eigenstrain = eigenstrain_.all(),
                       .traction_moment = CellField<Mandel>(eigenstrain_.any() ? n : 0),
                       .gradient = CellField<Tensor>(with_gradient ? n : 0),
                       .stress = CellField<Tensor>(n),
                       .energy = CellField<double>(n),
                       .part_energy = CellField<double>(part.size(), 0.0)};
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    const CellSums sums = sum_over_faces(c, moves, [](const auto*, const auto&, const auto&, const auto&) {});
    const Tensor gradient =
        with_strain_across(c, sums.gradient * skeleton_.closure[c].transpose() / skeleton_.mesh.cell_volume[c]);
    result.strain[c] = symmetric_part(gradient);
    result.energy[c] = sums.work;
    if (part.size() > 0) result.part_energy[c] = energy_of_part(c, part[c], result.strain[c], moves);
    if (with_gradient) result.gradient[c] = gradient;
    if (const double counts = cells_.layers().counts(c); counts > 0.0) {
      const Tensor of_lines = with_strain_across(c, lease->gradients[c]);
      result.strain[c] += counts * (symmetric_part(of_lines) - result.strain[c]);
      if (with_gradient) result.gradient[c] += counts * (of_lines - gradient);
    }
    finish_stress(c, sums, *lease, result);
  });
  add_histories(moves, result);
  result.face_displacement = std::move(u_face);
  return result;
}

}  // namespace pfdm
