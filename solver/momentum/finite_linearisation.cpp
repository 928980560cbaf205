// How the tractions of finite strain are linearised (finite_tractions.h).

#include "solver/momentum/acoustic_tensor.h"
#include "solver/momentum/finite_tractions.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {

using momentum_faces::Link;
using momentum_faces::LinkTensors;
using momentum_faces::Side;

namespace {

Tensor pushed_forward(double mu, double m, const Vector& c) { return mu * Tensor::Identity() + m * c * c.transpose(); }

// 1/J^2, where J < 1/2 its tangent there: a has to be finite and positive definite for every F.
double swelling(double J) { return J > 0.5 ? 1.0 / (J * J) : 12.0 - 16.0 * J; }
double swelling_slope(double J) { return J > 0.5 ? -2.0 / (J * J * J) : -16.0; }

// d(m c c^T) y = this dc.
Tensor turn_of(double m, const Vector& c, const Vector& y) {
  return m * (c.dot(y) * Tensor::Identity() + c * y.transpose());
}

}  // namespace

// m and dm/dJ of a law at J, times h; and what polyhedra keep of it.
FiniteTractions::Push FiniteTractions::push_of(const FiniteLaw& law, double J) {
  const double mu = law.swelling * law.face.mu;
  return {law.face.lambda + mu * swelling(J), mu * swelling_slope(J)};
}

FiniteTractions::Push FiniteTractions::capped(double share, const FiniteLaw& law, const Push& push) {
  const double mu = law.swelling * law.face.mu;
  return {share * (push.stiffness + mu) - mu, share * push.slope};
}

void FiniteTractions::set(const FiniteLawAt& law, const CellField<double>& g, const std::vector<Vector>& u, double part,
                          Sweep& sweep) {
  FiniteSweep& s = of(sweep);
  cells_.weigh(g, part);
  cells_.leave_out_third_order();
  cells_.weigh_pressures(g);
  moved_faces_.weigh(g);
  reconstruct(u, s);
  moved_faces_.place(s.corner_moves);
  linearise_cells(law, s);
  if (has_pressures()) place_areas();
  set_face_tensors();
  find_changes(s);
  parallel_for(static_cast<Index>(link_tensors_.size()), [&](Index i) { turn_link(as_size(i), u, s); });
  parallel_for(static_cast<Index>(side_tensors_.size()), [&](Index i) { turn_side(as_size(i), u, s); });
  find_initial_sector_stress(s);
  if (has_pressures()) find_initial_volumes(u, s);
}

void FiniteTractions::linearise_cells(const FiniteLawAt& law, const FiniteSweep& s) {
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    laws_[c] = law(c, s.gradients[c]);
    F_[c] = Tensor::Identity() + s.gradients[c];
    cofactor_[c] = cofactor(F_[c]);
    push_[c] = push_of(laws_[c], F_[c].determinant());
    pressure_at_[c] = s.pressure.mean(c);
  });
  parallel_for(static_cast<Index>(bonded_states_.size()), [&](Index k) {
    State& at = bonded_states_[as_size(k)];
    const Tensor& H = s.bonded[as_size(k)];
    at.law = law(skeleton_.sides[bonded_.side(as_size(k))].cell, H);
    at.F = Tensor::Identity() + H;
    at.cofactor = cofactor(at.F);
    at.push = push_of(at.law, at.F.determinant());
  });
}

void FiniteTractions::set_face_tensors() {
  parallel_for(static_cast<Index>(link_tensors_.size()), [&](Index i) {
    const Link& link = skeleton_.links[as_size(i)];
    const double h_P = link.h_P(), h_N = link.h_N();
    const Tensor a = acoustic(link.P, link.n) / h_P, b = acoustic(link.N, link.n) / h_N;
    const Tensor softness = (a + b).inverse(), weight = b * softness;
    link_tensors_[as_size(i)] = {.weight = weight, .c = jump_tensor(link, h_P, h_N), .softness = softness};
  });
  parallel_for(static_cast<Index>(side_tensors_.size()), [&](Index i) {
    side_tensors_[as_size(i)] = side_acoustic(as_size(i)) / skeleton_.sides[as_size(i)].h();
  });
}

void FiniteTractions::find_initial_sector_stress(const FiniteSweep& s) {
  const Vector& across = skeleton_.unknowns.plane_normal;
  parallel_for(s.sector_stress.size(), [&](Index c) {
    const double pressure = has_pressures() ? pressure_at_[c] * moved_faces_.section(c) : 0.0;
    initial_sector_[c] = across.dot(laws_[c].stress * across) + pressure - s.sector_stress[c];
  });
}

Vector FiniteTractions::true_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                      const FiniteSweep& s) const {
  const Vector t = true_stress_at(cell, turn) * n;
  return has_pressures() ? (t + s.pressure.at(cell, d) * moved_faces_.area(skeleton_.force_at(turn))).eval() : t;
}

// m and dm/dJ are those of the face.
FiniteTractions::FaceTurn FiniteTractions::face_turn(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                                     const Push& m, const Vector& y, const FiniteSweep& s) const {
  const Change& at = change_at(cell, turn, s);
  const Vector c = cofactor_at(cell, turn) * n;
  FaceTurn by{.turn = turn_of(m.stiffness, c, y),
              .swell = m.slope * c.dot(y) * c,
              .initial = (true_stress_at(cell, turn) - at.stress) * n,
              .pressure = s.pressure.at(cell, d)};
  by.initial -= by.turn * (at.cofactor * n) + by.swell * at.volume;
  if (has_pressures()) by.initial -= by.pressure * s.area_changes[skeleton_.force_at(turn)];
  return by;
}

void FiniteTractions::turn_link(std::size_t i, const std::vector<Vector>& u, const FiniteSweep& s) {
  const Link& link = skeleton_.links[i];
  const LinkTensors& by = link_tensors_[i];
  const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Vector jump =
      u[as_size(link.N)] + s.gradients[link.N] * link.d_N - u[as_size(link.P)] - s.gradients[link.P] * link.d_P;
  const Vector step = true_traction(link.N, link.n, link.d_N, N, s) - true_traction(link.P, link.n, link.d_P, P, s);
  const Vector y_P = by.weight.transpose() * jump + by.softness * step, y_N = jump - y_P;
  face_turns_[P] = face_turn(link.P, link.n, link.d_P, P, push_[link.P] / link.h_P(), y_P, s);
  face_turns_[N] = face_turn(link.N, link.n, link.d_N, N, push_[link.N] / link.h_N(), y_N, s);
  if (!jump_turns_.empty()) turn_jump(i, jump, s);
}

// With C = (a^-1 + b^-1)^-1 of the tractions and C_s of the jump, what the derivative of
// (1 - theta) (C_s - C) jump adds: dC = C a^-1 da a^-1 C + C b^-1 db b^-1 C.
void FiniteTractions::turn_jump(std::size_t i, const Vector& jump, const FiniteSweep& s) {
  const Link& link = skeleton_.links[i];
  const double share = 1.0 - stiffness_difference(link);
  const double h_P = link.h_P(), h_N = link.h_N();
  const Tensor small = in_series(capped_acoustic(link.P, link.n), h_P, capped_acoustic(link.N, link.n), h_N);
  const Tensor full = in_series(acoustic(link.P, link.n), h_P, acoustic(link.N, link.n), h_N);
  const auto turn = [&](Index cell, double h, Tensor& by_c, Vector& by_J) {
    const Vector c = cofactor_[cell] * link.n;
    const Tensor by_small = h * small * capped_acoustic(cell, link.n).inverse();
    const Tensor by_full = h * full * acoustic(cell, link.n).inverse();
    const Vector y_small = by_small.transpose() * jump, y_full = by_full.transpose() * jump;
    const Push m_small = capped_push(cell) / h, m_full = push_[cell] / h;
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
  const Vector gap = u[as_size(side.node)] - u[as_size(side.cell)] - rise(side.cell, side.d, turn, s);
  face_turns_[turn] = face_turn(side.cell, side.n, side.d, turn, side_push(i) / side.h(), gap, s);
}

CellField<double> FiniteTractions::face_stiffness() const {
  CellField<double> measure(as_size(laws_.size()));
  parallel_for(laws_.size(), [&](Index c) {
    measure[c] = 3.0 * laws_[c].face.mu + push_[c].stiffness * cofactor_[c].squaredNorm() / 3.0;
  });
  return measure;
}

FiniteTractions::Push FiniteTractions::side_push(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  const Index k = bonded_at(skeleton_.turn_of_side(i));
  if (k < 0) return capped_push(side.cell);
  const State& at = bonded_states_[as_size(k)];
  const Push single = capped(jump_share_[side.cell], at.law, at.push);
  return {BondedSides::stiffer * single.stiffness, BondedSides::stiffer * single.slope};
}

Tensor FiniteTractions::acoustic(Index cell, const Vector& n) const {
  return pushed_forward(laws_[cell].face.mu, push_[cell].stiffness, cofactor_[cell] * n);
}

// Of polyhedra with the share of lambda + 2 mu that their jump keeps, undeformed.
Tensor FiniteTractions::capped_acoustic(Index cell, const Vector& n) const {
  return pushed_forward(laws_[cell].face.mu, capped_push(cell).stiffness, cofactor_[cell] * n);
}

Tensor FiniteTractions::side_acoustic(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  const Index k = bonded_at(skeleton_.turn_of_side(i));
  if (k < 0) return capped_acoustic(side.cell, side.n);
  const State& at = bonded_states_[as_size(k)];
  return pushed_forward(BondedSides::stiffer * at.law.face.mu, side_push(i).stiffness, at.cofactor * side.n);
}

double FiniteTractions::stiffness_difference(const Link& link) const {
  const double mu_P = laws_[link.P].face.mu, mu_N = laws_[link.N].face.mu;
  return 1.0 - std::min(mu_P, mu_N) / std::max(mu_P, mu_N);
}

// c: the stiffness of both sides in series; between polyhedra that of the capped ones, blended back to the full one
// where the stiffness of the cells differs.
Tensor FiniteTractions::jump_tensor(const Link& link, double h_P, double h_N) const {
  Tensor full = in_series(acoustic(link.P, link.n), h_P, acoustic(link.N, link.n), h_N);
  if (jump_share_[link.P] == 1.0 && jump_share_[link.N] == 1.0) return full;
  const Tensor small = in_series(capped_acoustic(link.P, link.n), h_P, capped_acoustic(link.N, link.n), h_N);
  return small + stiffness_difference(link) * (full - small);
}

}  // namespace pfdm
