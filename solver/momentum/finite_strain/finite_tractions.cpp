#include "solver/momentum/finite_strain/finite_tractions.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

using momentum_faces::bounded_height;
using momentum_faces::Link;
using momentum_faces::LinkTensors;
using momentum_faces::Side;
using momentum_faces::SplitFace;

FiniteTractions::FiniteTractions(const FaceSkeleton& skeleton, CellReconstruction& cells,
                                 const CellEigenstrain& eigenstrain)
    : FaceTractions(skeleton),
      cells_(cells.take_lines_alone()),
      eigenstrain_(eigenstrain),
      states_(skeleton, cells.layers()),
      pressure_(skeleton, cells.pressure(), states_),
      weights_(cells.layers(), skeleton.links.size()),
      memory_(skeleton),
      initial_sector_(skeleton.sector_area.size(), 0.0),
      face_turns_(skeleton.n_turns()),
      link_tensors_(skeleton.links.size()),
      side_tensors_(skeleton.sides.size()) {
  const auto is_capped = [&](const Link& link) { return states_.is_capped(link); };
  if (std::ranges::any_of(skeleton.links, is_capped)) jump_turns_.resize(skeleton.links.size());
}

std::unique_ptr<Sweep> FiniteTractions::new_sweep() const {
  auto s = std::make_unique<FiniteSweep>(skeleton_);
  pressure_.prepare(*s);
  s->changes.of_cell = CellField<Change>(skeleton_.mesh.n_cells());
  s->changes.on_side.resize(states_.n_own());
  s->layers.assign(cells_.layers().any() ? skeleton_.n_turns() : 0, Tensor::Zero());
  return s;
}

void FiniteTractions::reconstruct(const std::vector<Vector>& u, FiniteSweep& s) const {
  cells_.find_gradients(u, s.gradients);
  if (cells_.layers().any()) cells_.layers().correct(u, s.gradients, s.layers);
  pressure_.read(u, s.gradients, s);
  const std::size_t n_bonded = states_.bonded().size();
  parallel_for(static_cast<Index>(states_.n_own() - n_bonded), [&](Index i) {
    const std::size_t k = n_bonded + as_size(i), side = states_.side_of_own(k);
    s.on_sides[k] = s.gradients[skeleton_.sides[side].cell] + s.layers[skeleton_.turn_of_side(side)];
  });
}

void FiniteTractions::find_changes(FiniteSweep& s) const {
  pressure_.find_area_changes(s.gradients, s);
  states_.find_changes(s.gradients, s.on_sides, s.changes);
  const Vector& across = skeleton_.unknowns.plane_normal;
  parallel_for(s.sector_stress.size(), [&](Index c) {
    s.sector_stress[c] = across.dot(s.changes.of_cell[c].stress * across);
    if (pressure_.any())
      s.sector_stress[c] +=
          s.pressure.mean(c) * pressure_.section(c) + pressure_.linearised_at(c) * pressure_.section_change(c, s);
  });
}

Vector FiniteTractions::linear_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                        const FiniteSweep& s) const {
  const FaceTurn& by = face_turns_[turn];
  const Change& at = states_.change_at(cell, turn, s.changes);
  const Vector t = at.stress * n + by.turn * (at.cofactor * n) + by.swell * at.volume;
  if (!pressure_.any()) return t;
  const std::size_t i = skeleton_.force_at(turn);
  return t + s.pressure.at(cell, d) * pressure_.area(i) + by.pressure * s.area_changes[i];
}

void FiniteTractions::find_linear(const std::vector<Vector>& u, Sweep& sweep) const {
  FiniteSweep& s = of(sweep);
  reconstruct(u, s);
  find_changes(s);
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Link& link = skeleton_.links[i];
    const LinkTensors& by = link_tensors_[i];
    const Vector stress_P = linear_traction(link.P, link.n, link.d_P, FaceSkeleton::turn_P(i), s);
    const Vector stress_N = linear_traction(link.N, link.n, link.d_N, FaceSkeleton::turn_N(i), s);
    const Vector u_P = u[link.P] + s.gradients[link.P] * link.d_P;
    const Vector jump = u[link.N] + s.gradients[link.N] * link.d_N - u_P;
    if (!s.moved.empty()) s.moved[i] = u_P + by.weight.transpose() * jump + by.softness * (stress_N - stress_P);
    s.force[i] = link.area * (stress_N + by.weight * (stress_P - stress_N) + by.c * weights_.weigh(i, jump));
    if (weights_.turns(i)) s.force[i] += link.area * weights_.change(i, s.gradients[link.P], s.gradients[link.N]);
    if (!jump_turns_.empty()) s.force[i] += link.area * turned_jump(i, s);
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Side& side = skeleton_.sides[i];
    const std::size_t turn = skeleton_.turn_of_side(i);
    const Vector gap = u[side.node] - u[side.cell] - rise(side.cell, side.d, turn, s);
    const Vector stress = linear_traction(side.cell, side.n, side.d, turn, s);
    s.force[n_links + i] = side.area * (stress + side_tensors_[i] * gap);
    if (s.moved.empty()) return;
    const Tensor& on_side = states_.change_at(side.cell, turn, s.changes).stress;
    s.moved[n_links + i] = u[side.node] + lag(i, on_side, s.changes.of_cell[side.cell].stress);
  });
}

Vector FiniteTractions::lag(std::size_t i, const Tensor& stress_on_side, const Tensor& stress_of_cell) const {
  const Side& side = skeleton_.sides[i];
  if (states_.own(i) < 0 || states_.bonded().number(i) >= 0 || skeleton_.mesh.is_interior(side.face))
    return Vector::Zero();
  // Across the face alone, where it changes the volume: along it the softness would not turn with the face.
  const Vector c = states_.cofactor_at(side.cell, skeleton_.turn_of_side(i)) * side.n;
  const double across = c.dot(side_tensors_[i] * c) / c.squaredNorm();
  return skeleton_.unknowns.free_within(side.node) * (stress_on_side - stress_of_cell) * side.n / across;
}

std::vector<Vector> FiniteTractions::moves_of_faces(const FiniteSweep& s) const {
  std::vector<Vector> moves = s.moved;
  parallel_for(count_of(moves), [&](Index i) { moves[i] += moved_initial_[i]; });
  return moves;
}

bool FiniteTractions::add_constant(Sweep& s) const {
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Link& link = skeleton_.links[i];
    const Vector &on_P = face_turns_[FaceSkeleton::turn_P(i)].initial,
                 &on_N = face_turns_[FaceSkeleton::turn_N(i)].initial;
    s.force[i] += link.area * (on_N + link_tensors_[i].weight * (on_P - on_N));
    if (weights_.turns(i)) s.force[i] += link.area * weights_.initial(i);
    if (!jump_turns_.empty()) s.force[i] += link.area * jump_turns_[i].initial;
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    s.force[n_links + i] += skeleton_.sides[i].area * face_turns_[skeleton_.turn_of_side(i)].initial;
  });
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] += initial_sector_[c]; });
  return true;
}

Vector FiniteTractions::link_displacement(std::size_t i, const std::vector<Vector>& u, const Sweep& sweep) const {
  const FiniteSweep& s = of(sweep);
  const Link& link = skeleton_.links[i];
  const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Vector from_P = u[link.P] + s.gradients[link.P] * link.d_P;
  const Vector from_N = u[link.N] + s.gradients[link.N] * link.d_N;
  Vector stress_jump =
      linear_traction(link.N, link.n, link.d_N, N, s) - linear_traction(link.P, link.n, link.d_P, P, s);
  stress_jump += face_turns_[N].initial - face_turns_[P].initial;
  const Vector towards_N = link_tensors_[i].weight.transpose() * (from_N - from_P);
  return from_P + towards_N + link_tensors_[i].softness * stress_jump;
}

Vector FiniteTractions::turned_jump(std::size_t i, const FiniteSweep& s) const {
  const Link& link = skeleton_.links[i];
  const JumpTurn& turn = jump_turns_[i];
  const Change &P = s.changes.of_cell[link.P], &N = s.changes.of_cell[link.N];
  return turn.P * (P.cofactor * link.n) + turn.swell_P * P.volume + turn.N * (N.cofactor * link.n) +
         turn.swell_N * N.volume;
}

void FiniteTractions::turn_springs(const Sweep& sweep, const std::vector<FaceSpring>& springs,
                                   std::vector<Vector>& forces) const {
  const FiniteSweep& s = of(sweep);
  parallel_for(count_of(springs), [&](Index k) {
    const SplitFace& face = skeleton_.split_faces[k];
    const FaceSpring& spring = springs[k];
    const Vector turned = spring.turn_P * (s.changes.of_cell[face.P].cofactor * face.n) +
                          spring.turn_N * (s.changes.of_cell[face.N].cofactor * face.n);
    forces[k] += face.area * turned;
  });
}

Tensor FiniteTractions::compact_link(std::size_t i) const {
  const Link& link = skeleton_.links[i];
  return link.area * states_.jump_tensor(link, bounded_height(link.d_P, link.n), bounded_height(link.d_N, link.n));
}

Tensor FiniteTractions::compact_side(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  return (side.area / bounded_height(side.d, side.n)) * states_.side_acoustic(i);
}

double FiniteTractions::hoop_modulus(Index cell) const {
  const Vector& across = skeleton_.unknowns.plane_normal;
  return across.dot(states_.acoustic(cell, across) * across);
}

FiniteTractions::PressureRow FiniteTractions::pressure_row(std::size_t k) const {
  const Index c = skeleton_.unknowns.pressure_cells[k];
  return {.slope = pressure_.slope(k), .modulus = states_.law(c).face.constrained_modulus()};
}

void FiniteTractions::find_pressure_forces(const CellField<double>& q, Sweep& s) const {
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Link& link = skeleton_.links[i];
    const Vector& area = pressure_.area(i);
    s.force[i] = link.area * (q[link.N] * area + link_tensors_[i].weight * ((q[link.P] - q[link.N]) * area));
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Side& side = skeleton_.sides[i];
    s.force[n_links + i] = (side.area * q[side.cell]) * pressure_.area(n_links + i);
  });
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] = q[c] * pressure_.section(c); });
}

}  // namespace pfdm
