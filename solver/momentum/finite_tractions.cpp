#include "solver/momentum/finite_tractions.h"

#include "solver/momentum/polyhedral_jump.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

using momentum_faces::bounded_height;
using momentum_faces::Link;
using momentum_faces::LinkTensors;
using momentum_faces::Side;
using momentum_faces::SplitFace;

FiniteTractions::FiniteTractions(const FaceSkeleton& skeleton, CellReconstruction& cells)
    : FaceTractions(skeleton),
      cells_(cells),
      laws_(as_size(skeleton.mesh.n_cells())),
      F_(as_size(skeleton.mesh.n_cells())),
      cofactor_(as_size(skeleton.mesh.n_cells())),
      push_(as_size(skeleton.mesh.n_cells())),
      initial_sector_(as_size(skeleton.mesh.n_cells()), 0.0),
      jump_share_(jump_shares(skeleton.mesh, skeleton.unknowns)),
      face_turns_(skeleton.n_turns()),
      link_tensors_(skeleton.links.size()),
      side_tensors_(skeleton.sides.size()),
      pressure_at_(as_size(skeleton.mesh.n_cells()), 0.0),
      bonded_(skeleton.mesh, skeleton.unknowns, skeleton.sides, [](Index) { return true; }),
      bonded_states_(bonded_.size()),
      moved_faces_(skeleton.mesh, skeleton.unknowns, skeleton.places_by_force(), bonded_) {
  const auto is_capped = [&](const Link& link) { return jump_share_[link.P] < 1.0 || jump_share_[link.N] < 1.0; };
  if (std::ranges::any_of(skeleton.links, is_capped)) jump_turns_.resize(skeleton.links.size());
}

std::unique_ptr<Sweep> FiniteTractions::new_sweep() const {
  auto s = std::make_unique<FiniteSweep>(skeleton_);
  s->pressure = cells_.pressure().field();
  s->bonded.resize(bonded_.size());
  s->changes = CellField<Change>(as_size(skeleton_.mesh.n_cells()));
  s->bonded_changes.resize(bonded_.size());
  if (!has_pressures()) return s;
  s->moved.resize(skeleton_.links.size());
  s->area_changes.resize(skeleton_.n_forces());
  s->flux.resize(skeleton_.n_forces());
  return s;
}

void FiniteTractions::reconstruct(const std::vector<Vector>& u, FiniteSweep& s) const {
  cells_.find_gradients(u, s.gradients);
  if (has_pressures()) cells_.pressure().read(u, s.pressure);
  parallel_for(static_cast<Index>(bonded_.size()), [&](Index k) {
    const Index c = skeleton_.sides[bonded_.side(as_size(k))].cell;
    s.bonded[as_size(k)] = bonded_.gradient(as_size(k), u, s.gradients[c]);
  });
  moved_faces_.move({u, s.gradients, s.bonded}, s.corner_moves);
}

FiniteTractions::Change FiniteTractions::change_of(const FiniteLaw& law, const Tensor& F, const Tensor& cofactor,
                                                   const Tensor& H) const {
  return {.stress = from_components(law.A * to_components(H)),
          .cofactor = cofactor_change(F, H),
          .volume = contract(cofactor, H)};
}

void FiniteTractions::find_changes(FiniteSweep& s) const {
  find_area_changes(s);
  const Vector& across = skeleton_.unknowns.plane_normal;
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    s.changes[c] = change_of(laws_[c], F_[c], cofactor_[c], s.gradients[c]);
    if (s.sector_stress.size() == 0) return;
    s.sector_stress[c] = across.dot(s.changes[c].stress * across);
    if (has_pressures())
      s.sector_stress[c] += s.pressure.mean(c) * moved_faces_.section(c) +
                            pressure_at_[c] * moved_faces_.section_change(c, s.corner_moves);
  });
  parallel_for(static_cast<Index>(bonded_states_.size()), [&](Index k) {
    const State& at = bonded_states_[as_size(k)];
    s.bonded_changes[as_size(k)] = change_of(at.law, at.F, at.cofactor, s.bonded[as_size(k)]);
  });
}

Vector FiniteTractions::linear_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                        const FiniteSweep& s) const {
  const FaceTurn& by = face_turns_[turn];
  const Change& at = change_at(cell, turn, s);
  const Vector t = at.stress * n + by.turn * (at.cofactor * n) + by.swell * at.volume;
  if (!has_pressures()) return t;
  const std::size_t i = skeleton_.force_at(turn);
  return t + s.pressure.at(cell, d) * moved_faces_.area(i) + by.pressure * s.area_changes[i];
}

void FiniteTractions::find_linear(const std::vector<Vector>& u, Sweep& sweep) const {
  FiniteSweep& s = of(sweep);
  reconstruct(u, s);
  find_changes(s);
  const auto n_links = static_cast<Index>(skeleton_.links.size());
  parallel_for(n_links, [&](Index index) {
    const std::size_t i = as_size(index);
    const Link& link = skeleton_.links[i];
    const LinkTensors& by = link_tensors_[i];
    const Vector stress_P = linear_traction(link.P, link.n, link.d_P, FaceSkeleton::turn_P(i), s);
    const Vector stress_N = linear_traction(link.N, link.n, link.d_N, FaceSkeleton::turn_N(i), s);
    const Vector u_P = u[as_size(link.P)] + s.gradients[link.P] * link.d_P;
    const Vector jump = u[as_size(link.N)] + s.gradients[link.N] * link.d_N - u_P;
    if (!s.moved.empty()) s.moved[i] = u_P + by.weight.transpose() * jump + by.softness * (stress_N - stress_P);
    s.force[i] = link.area * (stress_N + by.weight * (stress_P - stress_N) + by.c * jump);
    if (!jump_turns_.empty()) s.force[i] += link.area * turned_jump(i, s);
  });
  parallel_for(static_cast<Index>(skeleton_.sides.size()), [&](Index i) {
    const Side& side = skeleton_.sides[as_size(i)];
    const std::size_t turn = skeleton_.turn_of_side(as_size(i));
    const Vector gap = u[as_size(side.node)] - u[as_size(side.cell)] - rise(side.cell, side.d, turn, s);
    const Vector stress = linear_traction(side.cell, side.n, side.d, turn, s);
    s.force[as_size(n_links + i)] = side.area * (stress + side_tensors_[as_size(i)] * gap);
  });
}

bool FiniteTractions::add_constant(Sweep& s) const {
  const auto n_links = static_cast<Index>(skeleton_.links.size());
  parallel_for(n_links, [&](Index index) {
    const std::size_t i = as_size(index);
    const Link& link = skeleton_.links[i];
    const Vector &on_P = face_turns_[FaceSkeleton::turn_P(i)].initial,
                 &on_N = face_turns_[FaceSkeleton::turn_N(i)].initial;
    s.force[i] += link.area * (on_N + link_tensors_[i].weight * (on_P - on_N));
    if (!jump_turns_.empty()) s.force[i] += link.area * jump_turns_[i].initial;
  });
  parallel_for(static_cast<Index>(skeleton_.sides.size()), [&](Index i) {
    s.force[as_size(n_links + i)] +=
        skeleton_.sides[as_size(i)].area * face_turns_[skeleton_.turn_of_side(as_size(i))].initial;
  });
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] += initial_sector_[c]; });
  return true;
}

Vector FiniteTractions::link_displacement(std::size_t i, const std::vector<Vector>& u, const Sweep& sweep) const {
  const FiniteSweep& s = of(sweep);
  const Link& link = skeleton_.links[i];
  const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Vector from_P = u[as_size(link.P)] + s.gradients[link.P] * link.d_P;
  const Vector from_N = u[as_size(link.N)] + s.gradients[link.N] * link.d_N;
  Vector stress_jump =
      linear_traction(link.N, link.n, link.d_N, N, s) - linear_traction(link.P, link.n, link.d_P, P, s);
  stress_jump += face_turns_[N].initial - face_turns_[P].initial;
  const Vector towards_N = link_tensors_[i].weight.transpose() * (from_N - from_P);
  return from_P + towards_N + link_tensors_[i].softness * stress_jump;
}

Vector FiniteTractions::turned_jump(std::size_t i, const FiniteSweep& s) const {
  const Link& link = skeleton_.links[i];
  const JumpTurn& turn = jump_turns_[i];
  const Change &P = s.changes[link.P], &N = s.changes[link.N];
  return turn.P * (P.cofactor * link.n) + turn.swell_P * P.volume + turn.N * (N.cofactor * link.n) +
         turn.swell_N * N.volume;
}

void FiniteTractions::turn_springs(const Sweep& sweep, const std::vector<FaceSpring>& springs,
                                   std::vector<Vector>& forces) const {
  const FiniteSweep& s = of(sweep);
  parallel_for(static_cast<Index>(springs.size()), [&](Index k) {
    const SplitFace& face = skeleton_.split_faces[as_size(k)];
    const FaceSpring& spring = springs[as_size(k)];
    const Vector turned =
        spring.turn_P * (s.changes[face.P].cofactor * face.n) + spring.turn_N * (s.changes[face.N].cofactor * face.n);
    forces[as_size(k)] += face.area * turned;
  });
}

Tensor FiniteTractions::compact_link(std::size_t i) const {
  const Link& link = skeleton_.links[i];
  return link.area * jump_tensor(link, bounded_height(link.d_P, link.n), bounded_height(link.d_N, link.n));
}

Tensor FiniteTractions::compact_side(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  return (side.area / bounded_height(side.d, side.n)) * side_acoustic(i);
}

double FiniteTractions::hoop_modulus(Index cell) const {
  const Vector& across = skeleton_.unknowns.plane_normal;
  return across.dot(acoustic(cell, across) * across);
}

}  // namespace pfdm
