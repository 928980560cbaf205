// Linearisation of the tractions of finite strain (finite_tractions.h).

#include "solver/momentum/faces/acoustic_tensor.h"
#include "solver/momentum/finite_strain/finite_tractions.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

using momentum_faces::Link;
using momentum_faces::LinkTensors;
using momentum_faces::Side;

namespace {

// d(m c c^T) y = this dc.
Tensor turn_of(double m, const Vector& c, const Vector& y) {
  return m * (c.dot(y) * Tensor::Identity() + c * y.transpose());
}

}  // namespace

void FiniteTractions::set(const FiniteLawAt& law, const std::vector<GapStress>& gaps, const CellField<double>& g,
                          const std::vector<Vector>& u, double part, Sweep& sweep) {
  FiniteSweep& s = of(sweep);
  cells_.weigh(g, part);
  cells_.weigh_third_order(g);
  cells_.weigh_pressures(g);
  pressure_.weigh(g);
  reconstruct(u, s);
  states_.extrapolate(cells_.layers(), eigenstrain_.all());
  states_.linearise(law, s.gradients, s.on_sides);
  memory_.set(gaps);
  memory_.turn(states_);
  pressure_.linearise(s);
  set_face_tensors();
  find_changes(s);
  parallel_for(count_of(link_tensors_), [&](Index i) { turn_link(i, u, s); });
  parallel_for(count_of(side_tensors_), [&](Index i) { turn_side(i, u, s); });
  find_initial_sector_stress(s);
  if (pressure_.any()) linearise_volumes(u, s);
}

void FiniteTractions::set_face_tensors() {
  parallel_for(count_of(link_tensors_), [&](Index i) {
    const Link& link = skeleton_.links[i];
    const double h_P = link.h_P(), h_N = link.h_N();
    const Tensor a = states_.acoustic(link.P, link.n) / h_P, b = states_.acoustic(link.N, link.n) / h_N;
    const Tensor softness = (a + b).inverse(), weight = b * softness;
    link_tensors_[i] = {.weight = weight, .c = states_.jump_tensor(link, h_P, h_N), .softness = softness};
  });
  parallel_for(count_of(side_tensors_),
               [&](Index i) { side_tensors_[i] = states_.side_acoustic(i) / skeleton_.sides[i].h(); });
}

void FiniteTractions::find_initial_sector_stress(const FiniteSweep& s) {
  const Vector& across = skeleton_.unknowns.plane_normal;
  parallel_for(s.sector_stress.size(), [&](Index c) {
    const double pressure = pressure_.any() ? pressure_.linearised_at(c) * pressure_.section(c) : 0.0;
    initial_sector_[c] = across.dot(states_.law(c).stress * across) + pressure - s.sector_stress[c];
  });
}

Vector FiniteTractions::true_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                      const FiniteSweep& s) const {
  const Vector t = states_.stress_at(cell, turn) * n + remembered(cell, n, turn);
  return pressure_.any() ? (t + s.pressure.at(cell, d) * pressure_.area(skeleton_.force_at(turn))).eval() : t;
}

Vector FiniteTractions::remembered(Index cell, const Vector& n, std::size_t turn) const {
  if (!memory_.any()) return Vector::Zero();
  const Vector c = states_.cofactor_at(cell, turn) * n, &x = memory_.left(turn);
  const double bulk = states_.jump_share(cell) * memory_.bulk_left(turn);
  return x + (states_.memory_push(cell, turn).stiffness * c.dot(x) + bulk) * c;
}

void FiniteTractions::remember(Index cell, const Vector& c, std::size_t turn, FaceTurn& by) const {
  if (!memory_.any()) return;
  const Push m = states_.memory_push(cell, turn);
  const Vector& x = memory_.left(turn);
  by.turn += turn_of(m.stiffness, c, x) + states_.jump_share(cell) * memory_.bulk_left(turn) * Tensor::Identity();
  by.swell += m.slope * c.dot(x) * c;
}

// m and dm/dJ are those of the face.
FiniteTractions::FaceTurn FiniteTractions::face_turn(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                                     const Push& m, const Vector& y, const FiniteSweep& s) const {
  const Change& at = states_.change_at(cell, turn, s.changes);
  const Vector c = states_.cofactor_at(cell, turn) * n;
  FaceTurn by{.turn = turn_of(m.stiffness, c, y),
              .swell = m.slope * c.dot(y) * c,
              .initial = (states_.stress_at(cell, turn) - at.stress) * n + remembered(cell, n, turn),
              .pressure = s.pressure.at(cell, d)};
  remember(cell, c, turn, by);
  by.initial -= by.turn * (at.cofactor * n) + by.swell * at.volume;
  if (pressure_.any()) by.initial -= by.pressure * s.area_changes[skeleton_.force_at(turn)];
  return by;
}

void FiniteTractions::turn_link(std::size_t i, const std::vector<Vector>& u, const FiniteSweep& s) {
  const Link& link = skeleton_.links[i];
  const LinkTensors& by = link_tensors_[i];
  const CellField<Tensor>& F = states_.deformation();
  const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Vector jump = u[link.N] + s.gradients[link.N] * link.d_N - u[link.P] - s.gradients[link.P] * link.d_P;
  const Vector step = true_traction(link.N, link.n, link.d_N, N, s) - true_traction(link.P, link.n, link.d_P, P, s);
  if (weights_.turns(i)) weights_.linearise(i, F[link.P], F[link.N], by.c, jump);
  const Vector weighed = weights_.weigh(i, jump);
  const Vector y_P = by.weight.transpose() * weighed + by.softness * step, y_N = weighed - y_P;
  face_turns_[P] = face_turn(link.P, link.n, link.d_P, P, states_.push(link.P) / link.h_P(), y_P, s);
  face_turns_[N] = face_turn(link.N, link.n, link.d_N, N, states_.push(link.N) / link.h_N(), y_N, s);
  if (!jump_turns_.empty()) turn_jump(i, jump, s);
}

// With C = (a^-1 + b^-1)^-1 of the tractions and C_s of the jump, what the derivative of
// (1 - theta) (C_s - C) jump adds: dC = C a^-1 da a^-1 C + C b^-1 db b^-1 C.
void FiniteTractions::turn_jump(std::size_t i, const Vector& jump, const FiniteSweep& s) {
  const Link& link = skeleton_.links[i];
  const double share = 1.0 - states_.stiffness_difference(link);
  const double h_P = link.h_P(), h_N = link.h_N();
  const Tensor small =
      in_series(states_.capped_acoustic(link.P, link.n), h_P, states_.capped_acoustic(link.N, link.n), h_N);
  const Tensor full = in_series(states_.acoustic(link.P, link.n), h_P, states_.acoustic(link.N, link.n), h_N);
  const auto turn = [&](Index cell, double h, Tensor& by_c, Vector& by_J) {
    const Vector c = states_.cofactors()[cell] * link.n;
    const Tensor by_small = h * small * states_.capped_acoustic(cell, link.n).inverse();
    const Tensor by_full = h * full * states_.acoustic(cell, link.n).inverse();
    const Vector y_small = by_small.transpose() * jump, y_full = by_full.transpose() * jump;
    const Push m_small = states_.capped_push(cell) / h, m_full = states_.push(cell) / h;
    by_c = share * (by_small * turn_of(m_small.stiffness, c, y_small) - by_full * turn_of(m_full.stiffness, c, y_full));
    by_J = share * (m_small.slope * c.dot(y_small) * by_small * c - m_full.slope * c.dot(y_full) * by_full * c);
  };
  JumpTurn& turned = jump_turns_[i];
  turn(link.P, h_P, turned.P, turned.swell_P);
  turn(link.N, h_N, turned.N, turned.swell_N);
  turned.initial = -turned_jump(i, s);
}

void FiniteTractions::turn_side(std::size_t i, const std::vector<Vector>& u, const FiniteSweep& s) {
  const Side& side = skeleton_.sides[i];
  const std::size_t turn = skeleton_.turn_of_side(i);
  const Vector gap = u[side.node] - u[side.cell] - rise(side.cell, side.d, turn, s);
  face_turns_[turn] = face_turn(side.cell, side.n, side.d, turn, states_.side_push(i) / side.h(), gap, s);
}

void FiniteTractions::linearise_volumes(const std::vector<Vector>& u, FiniteSweep& s) {
  find_linear(u, s);
  moved_initial_.assign(skeleton_.n_forces(), Vector::Zero());
  const Index n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Vector jump = face_turns_[FaceSkeleton::turn_N(i)].initial - face_turns_[FaceSkeleton::turn_P(i)].initial;
    moved_initial_[i] = link_tensors_[i].softness * jump;
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Index cell = skeleton_.sides[i].cell, force = n_links + i;
    const Vector lag_now = lag(i, states_.stress_at(cell, skeleton_.turn_of_side(i)), states_.law(cell).stress);
    moved_initial_[force] = u[skeleton_.sides[i].node] + lag_now - s.moved[force];
  });
  pressure_.linearise_volumes(moves_of_faces(s), s);
}

}  // namespace pfdm
