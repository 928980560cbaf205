// Strain, stress and energy of the cells at finite strain (finite_tractions.h). The energy of a cell is that of its
// mean gradient and half the work of what tractions and face displacements differ by from those; with a pressure this
// is without the pressure's work.

#include "solver/momentum/finite_strain/finite_tractions.h"
#include "solver/momentum/finite_strain/polar_parts.h"
#include "solver/parallel.h"

#include <cmath>
#include <numeric>

namespace pfdm {

using momentum_faces::Link;

namespace {

Tensor skew_part(const Tensor& A) { return 0.5 * (A - A.transpose()); }

// The tractions of a cell have a moment about its centre; those of all cells together are in balance with the loads.
// In the sheared cells along a bonded surface it does 1 % of the work, in tetrahedra around inclusions that do not fit
// up to 40 %. At the rotation R of a cell, beyond the rotation R_0 of the whole body: 1/2 V skew(P R^T) : skew(R
// R_0^T).
void add_moments(const Mesh& mesh, const std::vector<Index>& of_cells, const CellField<Tensor>& stress,
                 CellMechanics& cells) {
  if (of_cells.empty()) return;
  Tensor whole = Tensor::Zero();
  double volume = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    whole += mesh.cell_volume[c] * (Tensor::Identity() + cells.gradient[c]);
    volume += mesh.cell_volume[c];
  }
  const Tensor R_0 = polar_parts(whole / volume).R;
  parallel_for(count_of(of_cells), [&](Index k) {
    const Index c = of_cells[k];
    const Tensor R = polar_parts(Tensor::Identity() + cells.gradient[c]).R;
    const Tensor moment = skew_part(stress[c] * R.transpose());
    cells.moment_work[c] = 0.5 * mesh.cell_volume[c] * contract(moment, skew_part(R * R_0.transpose()));
  });
}

CellMechanics unknown_mechanics(std::size_t n_cells, std::size_t n_parts) {
  return {.strain = CellField<Tensor>(n_cells),
          .gradient = CellField<Tensor>(n_cells),
          .stress = CellField<Tensor>(n_cells),
          .energy = CellField<double>(n_cells),
          .moment_work = CellField<double>(n_cells, 0.0),
          .part_energy = CellField<double>(n_parts, 0.0)};
}

}  // namespace

Tensor FiniteTractions::elastic_spread(Index cell, Index line, const CellField<Tensor>& gradients) const {
  const LayerGradients& layers = cells_.layers();
  Tensor whole = layers.spread(line, gradients);
  if (!eigenstrain_.any()) return whole;
  const Tensor free = Tensor::Identity() + to_tensor(eigenstrain_[cell]);
  const Tensor of_free = to_tensor(layers.spread(line, eigenstrain_.all()));
  return whole - (Tensor::Identity() + gradients[cell]) * free.inverse() * of_free;
}

// The mean gradient is that along lines of cells where these count: the tractions are computed from it. The gradient
// varies along the lines, by h^2/12 times the square of its slope, and the cell has the energy of that in place of what
// tractions, face displacements and moments have. The variation of F* is none of it.
void FiniteTractions::find_within_layers(const CellField<Tensor>& gradients, CellMechanics& result) const {
  const LayerGradients& layers = cells_.layers();
  if (!layers.any()) return;
  layers.each_cell([&](Index c, double counts, Index first, Index end) {
    if (first == end) return;
    double within = 0.0;
    for (Index line = first; line < end; ++line) {
      const auto spread = to_components(elastic_spread(c, line, gradients));
      within += 0.5 * skeleton_.mesh.cell_volume[c] * spread.dot(states_.law(c).A * spread);
    }
    result.gradient[c] += counts * (gradients[c] - result.gradient[c]);
    result.strain[c] = symmetric_part(result.gradient[c]);
    result.energy[c] += counts * (within - result.energy[c]);
    result.moment_work[c] *= 1.0 - counts;
  });
}

// Counts the work of moments in all cells of bodies with eigenstrains, else in those with a pressure.
void FiniteTractions::add_work_of_moments(CellMechanics& result) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  const CellField<Tensor>& stress = pressure_.any() ? result.moderate_stress : result.stress;
  if (!unknowns.loads.eigenstrain) return add_moments(skeleton_.mesh, unknowns.pressure_cells, stress, result);
  std::vector<Index> all(skeleton_.mesh.n_cells());
  std::iota(all.begin(), all.end(), Index{0});
  add_moments(skeleton_.mesh, all, stress, result);
}

// Displacement of a face beyond that of the cell and its gradient [m]. Across layers that bend the jump counts as its
// weights say.
Vector FiniteTractions::gap(Index cell, const Vector& d, std::size_t turn, const Vector& move,
                            const FaceMoves& moves) const {
  const FiniteSweep& s = of(moves.sweep);
  Vector whole = move - rise(cell, d, turn, s);
  const std::size_t i = turn / 2;
  if (skeleton_.is_side(turn) || !weights_.turns(i)) return whole;
  const Link& link = skeleton_.links[i];
  const Vector jump =
      moves.u[link.N] + s.gradients[link.N] * link.d_N - moves.u[link.P] - s.gradients[link.P] * link.d_P;
  const Vector idle = jump - weights_.weigh(i, jump);
  return whole - FaceSkeleton::idle_share(turn, idle, link_tensors_[i].weight.transpose() * idle);
}

// Gaps of viscoelastic cells, as strains that do not turn with the cell, and the gradients that laws have met.
void FiniteTractions::add_gaps(const FaceMoves& moves, CellMechanics& result) const {
  if (!memory_.any()) return;
  const Mesh& mesh = skeleton_.mesh;
  const FiniteSweep& s = of(moves.sweep);
  result.gaps.resize(mesh.cell_faces.size());
  result.gradients_of_laws.assign(s.gradients.begin(), s.gradients.end());
  for (std::size_t k = 0; k < states_.n_own(); ++k)
    result.gradients_of_laws.push_back(states_.as_law_sees(k, s.on_sides[k]));
  parallel_for(mesh.n_cells(), [&](Index c) {
    if (!(states_.law(c).memory.share > 0.0)) return;
    memory_.visit_sides(c, [&](std::size_t at, Index f, std::size_t turn) {
      const Vector d = mesh.face_centre[f] - mesh.cell_centre[c];
      const double h = std::abs(d.dot(mesh.face_area[f].normalized()));
      const Vector move = moves.seen_from(c, f) - moves.u[c];
      const Vector y = gap(c, d, turn, move, moves), back = memory_.rotation(c).transpose() * y;
      const double scale = states_.stiffer_at(turn) / h;
      const Vector area = states_.cofactor_at(c, turn) * mesh.outward_area(f, c).normalized();
      result.gaps[at] = {.strain = scale * back,
                         .along = scale * area.dot(y),
                         .volume = mesh.face_area[f].norm() * h,
                         .by_shear = 1.0 + states_.memory_push(c, turn).stiffness,
                         .by_bulk = states_.jump_share(c)};
    });
  });
}

CellMechanics FiniteTractions::mechanics(const std::vector<Vector>& u, bool,
                                         const CellField<IsotropicElasticity>& part) const {
  const auto lease = sweep();
  FiniteSweep& s = of(*lease);
  find(u, s);
  FaceField<Vector> u_face = face_displacements(u, s);
  const FaceMoves moves{.skeleton = skeleton_, .sweep = s, .u = u, .u_face = u_face};
  CellMechanics result = unknown_mechanics(skeleton_.mesh.n_cells(), as_size(part.size()));
  if (pressure_.any()) {
    result.volume_change = pressure_.swept_changes(moves_of_faces(s), s);
    result.moderate_stress = CellField<Tensor>(skeleton_.mesh.n_cells());
  }
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    const double volume = skeleton_.mesh.cell_volume[c];
    Tensor pressed = Tensor::Zero();
    double by_pressure = 0.0;
    const auto press = [&](const FaceSkeleton::SignedForce* on, const Vector& area, const Vector& arm,
                           const Vector& move) {
      if (!pressure_.any()) return;
      const Vector on_face =
          s.pressure.mean(c) * (on != nullptr ? pressure_.moved_area(*on) : Vector(pressure_.section(c) * area));
      pressed += on_face * arm.transpose();
      by_pressure += 0.5 * on_face.dot(move);
    };
    const CellSums sums = sum_over_faces(c, moves, press);
    const Tensor& closure = skeleton_.closure[c];
    const Tensor gradient = sums.gradient * closure.transpose() / volume;
    result.gradient[c] = gradient;
    result.strain[c] = symmetric_part(gradient);
    result.stress[c] = sums.moment * closure / volume;
    if (pressure_.any()) result.moderate_stress[c] = (sums.moment - pressed) * closure / volume;
    result.energy[c] = sums.work - by_pressure - 0.5 * contract(sums.moment - pressed, gradient);
  });
  add_work_of_moments(result);
  find_within_layers(s.gradients, result);
  add_gaps(moves, result);
  result.face_displacement = std::move(u_face);
  return result;
}

}  // namespace pfdm
