// Finite strain in the momentum balance (momentum.h): tractions linearised about the last displacements. With
// y_P = u_f - u_P - H_P d_P and y_N = u_N + H_N d_N - u_f on the two sides of a face,
//
//   t = tau_P + a y_P = tau_N + b y_N,  tau = P(H) N + q c,
//
// so that a change of F, in cells whose a and pressure turn with c = cof F N, adds (q I + m ((c.y) I + c y^T)) dc +
// dm/dJ (c.y) c dJ to tau, m = (lambda + mu phi(J))/h. The balance is linear in the displacements, with these as they
// were at the last ones; its constant part makes it exact there.

#include "solver/momentum/acoustic_tensor.h"
#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

namespace pfdm {
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

void MomentumOperator::set_finite(const FiniteLawAt& law, const CellField<double>& g, const std::vector<Vector>& u,
                                  double t, double part) {
  const auto n = as_size(mesh_.n_cells());
  if (!is_finite()) {
    finite_ = CellField<FiniteLaw>(n);
    F_ = cofactor_ = stresses_ = cofactor_change_ = CellField<Tensor>(n);
    initial_sector_ = pressure_at_ = CellField<double>(n, 0.0);
    push_ = CellField<Push>(n);
    volume_rate_ = CellField<double>(n, 0.0);
    face_turns_.resize(2 * links_.size() + sides_.size());
    flux_.clear();
    if (pressure_.any()) moved_.resize(links_.size());
    for (const Link& link : links_)
      if (jump_share_[link.P] < 1.0 || jump_share_[link.N] < 1.0) jump_turns_.resize(links_.size());
  }
  gradient_.update(g, part);
  cubic_.leave_out();
  pressure_.weigh(g);
  reconstruct(u);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    finite_[c] = law(c, gradients_[c]);
    F_[c] = Tensor::Identity() + gradients_[c];
    cofactor_[c] = cofactor(F_[c]);
    const double J = F_[c].determinant();
    const IsotropicElasticity& face = finite_[c].face;
    const double mu = finite_[c].swelling * face.mu;
    push_[c] = {face.lambda + mu * swelling(J), mu * swelling_slope(J)};
    pressure_at_[c] = pressure_.mean(c);
  });
  pressed_faces_.linearise(t, u, gradients_, g);
  set_face_tensors();
  find_linear_stresses();
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) { turn_link(as_size(i), u); });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) { turn_side(as_size(i), u); });
  find_initial_sector_stress();
  if (pressure_.any()) find_initial_volumes(u);
}

void MomentumOperator::find_linear_stresses() const {
  const Vector& across = unknowns_.plane_normal;
  parallel_for(mesh_.n_cells(), [&](Index c) {
    stresses_[c] = from_components(finite_[c].A * to_components(gradients_[c]));
    cofactor_change_[c] = cofactor_change(F_[c], gradients_[c]);
    volume_rate_[c] = contract(cofactor_[c], gradients_[c]);
    if (sector_area_.size() == 0) return;
    const Tensor whole = stresses_[c] + pressure_.mean(c) * cofactor_[c] + pressure_at_[c] * cofactor_change_[c];
    sector_stress_[c] = across.dot(whole * across);
  });
}

void MomentumOperator::find_initial_sector_stress() {
  const Vector& across = unknowns_.plane_normal;
  parallel_for(sector_stress_.size(), [&](Index c) {
    const Tensor true_stress = finite_[c].stress + pressure_at_[c] * cofactor_[c];
    initial_sector_[c] = across.dot(true_stress * across) - sector_stress_[c];
  });
}

Vector MomentumOperator::true_traction(Index cell, const Vector& n, const Vector& d) const {
  return finite_[cell].stress * n + pressure_.at(cell, d) * (cofactor_[cell] * n);
}

// m and dm/dJ are those of the face.
MomentumOperator::FaceTurn MomentumOperator::face_turn(Index cell, const Vector& n, const Vector& d, const Push& m,
                                                       const Vector& y) const {
  const Vector c = cofactor_[cell] * n;
  FaceTurn turn{.turn = turn_of(m.stiffness, c, y) + pressure_.at(cell, d) * Tensor::Identity(),
                .swell = m.slope * c.dot(y) * c,
                .initial = (finite_[cell].stress - stresses_[cell]) * n};
  turn.initial -= turn.turn * (cofactor_change_[cell] * n) + turn.swell * volume_rate_[cell];
  return turn;
}

void MomentumOperator::turn_link(std::size_t i, const std::vector<Vector>& u) {
  const Link& link = links_[i];
  const LinkTensors& by = link_tensors_[i];
  const Vector jump =
      u[as_size(link.N)] + gradients_[link.N] * link.d_N - u[as_size(link.P)] - gradients_[link.P] * link.d_P;
  const Vector step = true_traction(link.N, link.n, link.d_N) - true_traction(link.P, link.n, link.d_P);
  const Vector y_P = by.weight.transpose() * jump + by.softness * step, y_N = jump - y_P;
  const double h_P = std::abs(link.d_P.dot(link.n)), h_N = std::abs(link.d_N.dot(link.n));
  face_turns_[turn_P(i)] = face_turn(link.P, link.n, link.d_P, push_[link.P] / h_P, y_P);
  face_turns_[turn_N(i)] = face_turn(link.N, link.n, link.d_N, push_[link.N] / h_N, y_N);
  if (!jump_turns_.empty()) turn_jump(i, jump);
}

// With C = (a^-1 + b^-1)^-1 of the tractions and C_s of the jump, what the derivative of
// (1 - theta) (C_s - C) jump adds: dC = C a^-1 da a^-1 C + C b^-1 db b^-1 C.
void MomentumOperator::turn_jump(std::size_t i, const Vector& jump) {
  const Link& link = links_[i];
  const double share = 1.0 - stiffness_difference(link);
  const double h_P = std::abs(link.d_P.dot(link.n)), h_N = std::abs(link.d_N.dot(link.n));
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
  turned.initial = -turned_jump(i);
}

Vector MomentumOperator::turned_jump(std::size_t i) const {
  const Link& link = links_[i];
  const JumpTurn& turn = jump_turns_[i];
  return turn.P * (cofactor_change_[link.P] * link.n) + turn.swell_P * volume_rate_[link.P] +
         turn.N * (cofactor_change_[link.N] * link.n) + turn.swell_N * volume_rate_[link.N];
}

Vector MomentumOperator::turned_spring(std::size_t k) const {
  const SplitFace& face = split_faces_[k];
  const FaceSpring& spring = springs_[k];
  return spring.turn_P * (cofactor_change_[face.P] * face.n) + spring.turn_N * (cofactor_change_[face.N] * face.n);
}

void MomentumOperator::turn_side(std::size_t i, const std::vector<Vector>& u) {
  const Side& side = sides_[i];
  const Vector gap = u[as_size(side.node)] - u[as_size(side.cell)] - gradients_[side.cell] * side.d;
  const Push m = capped_push(side.cell) / std::abs(side.d.dot(side.n));
  face_turns_[turn_of_side(i)] = face_turn(side.cell, side.n, side.d, m, gap);
}

Tensor MomentumOperator::acoustic(Index cell, const Vector& n) const {
  if (!is_finite()) return acoustic_tensor(stiffness_[cell], n);
  return pushed_forward(finite_[cell].face.mu, push_[cell].stiffness, cofactor_[cell] * n);
}

CellField<double> MomentumOperator::face_stiffness() const {
  CellField<double> measure(as_size(finite_.size()));
  parallel_for(finite_.size(), [&](Index c) {
    measure[c] = 3.0 * finite_[c].face.mu + push_[c].stiffness * cofactor_[c].squaredNorm() / 3.0;
  });
  return measure;
}

// Of polyhedra the share of lambda + 2 mu that momentum_jump.cpp keeps, undeformed.
MomentumOperator::Push MomentumOperator::capped_push(Index cell) const {
  const double share = jump_share_[cell], mu = finite_[cell].swelling * finite_[cell].face.mu;
  return {share * (push_[cell].stiffness + mu) - mu, share * push_[cell].slope};
}

Tensor MomentumOperator::capped_acoustic(Index cell, const Vector& n) const {
  if (!is_finite()) return acoustic(cell, n);
  return pushed_forward(finite_[cell].face.mu, capped_push(cell).stiffness, cofactor_[cell] * n);
}

double MomentumOperator::stiffness_difference(const Link& link) const {
  const double mu_P = finite_[link.P].face.mu, mu_N = finite_[link.N].face.mu;
  return 1.0 - std::min(mu_P, mu_N) / std::max(mu_P, mu_N);
}

// c: the stiffness of both sides in series; between polyhedra that of the capped ones, blended back to the full one
// where the stiffness of the cells differs.
Tensor MomentumOperator::jump_tensor(const Link& link, double h_P, double h_N) const {
  Tensor full = in_series(acoustic(link.P, link.n), h_P, acoustic(link.N, link.n), h_N);
  if (!is_finite() || (jump_share_[link.P] == 1.0 && jump_share_[link.N] == 1.0)) return full;
  const Tensor small = in_series(capped_acoustic(link.P, link.n), h_P, capped_acoustic(link.N, link.n), h_N);
  return small + stiffness_difference(link) * (full - small);
}

Vector MomentumOperator::linear_face_displacement(std::size_t i, const Vector& u_P, const Vector& jump,
                                                  const Vector& stress_jump) const {
  return u_P + link_tensors_[i].weight.transpose() * jump + link_tensors_[i].softness * stress_jump;
}

// Of the faces' displacements, those of links being in moved_.
Tensor MomentumOperator::mean_gradient(Index cell, const std::vector<Vector>& u) const {
  Tensor gradient = Tensor::Zero();
  for (const Index f : mesh_.faces_of_cell(cell)) {
    const Vector area = (mesh_.owner[f] == cell ? 1.0 : -1.0) * mesh_.face_area[f];
    const Index node = unknowns_.node_beside(mesh_, cell, f), force = force_of_face_[as_size(f)];
    const Vector at = node >= 0 ? u[as_size(node)] : force >= 0 ? moved_[as_size(force)] : moved_with(cell, f, u);
    gradient += (at - u[as_size(cell)]) * area.transpose();
  }
  return gradient * closure_[cell].transpose() / mesh_.cell_volume[cell];
}

// V (J(q) - det F), linearised.
void MomentumOperator::balance_finite_pressures(const std::vector<Vector>& u, std::vector<Vector>& out) const {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    const VolumeRow& row = volume_rows_[as_size(k)];
    const double rate = row.slope * pressure_.mean(c) - contract(row.cofactor, mean_gradient(c, u));
    out[as_size(unknowns_.n_nodes() + k)] = mesh_.cell_volume[c] * rate * Vector::UnitX();
  });
}

void MomentumOperator::find_initial_volumes(const std::vector<Vector>& u) {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  const auto n = static_cast<Index>(cells.size());
  volume_rows_.resize(cells.size());
  compute_linear_forces(u);
  CellField<Tensor> linear(as_size(mesh_.n_cells()));
  parallel_for(n, [&](Index k) { linear[cells[as_size(k)]] = mean_gradient(cells[as_size(k)], u); });
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) {
    const Vector jump = face_turns_[turn_N(as_size(i))].initial - face_turns_[turn_P(as_size(i))].initial;
    moved_[as_size(i)] += link_tensors_[as_size(i)].softness * jump;
  });
  parallel_for(n, [&](Index k) {
    const Index c = cells[as_size(k)];
    const Tensor H = mean_gradient(c, u);
    const VolumeAt volume = finite_[c].volume(pressure_at_[c]);
    VolumeRow& row = volume_rows_[as_size(k)];
    row.slope = volume.slope;
    row.cofactor = cofactor(Tensor::Identity() + H);
    row.initial = volume.change - volume.slope * pressure_at_[c] - volume_change(H) + contract(row.cofactor, linear[c]);
  });
}

void MomentumOperator::find_finite_pressure_forces(const CellField<double>& q) const {
  const auto n_links = static_cast<Index>(links_.size());
  parallel_for(n_links, [&](Index i) {
    const Link& link = links_[as_size(i)];
    const Vector on_P = q[link.P] * (cofactor_[link.P] * link.n), on_N = q[link.N] * (cofactor_[link.N] * link.n);
    forces_[as_size(i)] = link.area * (on_N + weigh(as_size(i), on_P - on_N));
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    forces_[as_size(n_links + i)] = (side.area * q[side.cell]) * (cofactor_[side.cell] * side.n);
  });
  const Vector& across = unknowns_.plane_normal;
  parallel_for(sector_stress_.size(), [&](Index c) { sector_stress_[c] = q[c] * across.dot(cofactor_[c] * across); });
}

}  // namespace pfdm
