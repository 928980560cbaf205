// Finite strain in the momentum balance (momentum.h): tractions linearised about the last displacements. With
// y_P = u_f - u_P - H_P d_P and y_N = u_N + H_N d_N - u_f on the two sides of a face,
//
//   t = tau_P + a y_P = tau_N + b y_N,  tau = P(H) N + q s,
//
// s being the area vector of the moved face over the undeformed area, so that a change of F, in cells whose a turns
// with c = cof F N, adds m ((c.y) I + c y^T) dc + dm/dJ (c.y) c dJ + q ds to tau, m = (lambda + mu phi(J))/h. The
// balance is linear in the displacements, with these as they were at the last ones; its constant part makes it exact
// there.

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

// m and dm/dJ of a law at J, times h; and what polyhedra keep of it.
momentum_faces::Push push_of(const FiniteLaw& law, double J) {
  const double mu = law.swelling * law.face.mu;
  return {law.face.lambda + mu * swelling(J), mu * swelling_slope(J)};
}
momentum_faces::Push capped(double share, const FiniteLaw& law, const momentum_faces::Push& push) {
  const double mu = law.swelling * law.face.mu;
  return {share * (push.stiffness + mu) - mu, share * push.slope};
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
    if (pressure_.any()) place_moved_faces();
    for (const Link& link : links_)
      if (jump_share_[link.P] < 1.0 || jump_share_[link.N] < 1.0) jump_turns_.resize(links_.size());
  }
  gradient_.update(g, part);
  leave_out_third_order();
  pressure_.weigh(g);
  moved_faces_.weigh(g);
  reconstruct(u);
  find_bonded_gradients(u);
  moved_faces_.move(field(u), corner_moves_);
  moved_faces_.place(corner_moves_);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    finite_[c] = law(c, gradients_[c]);
    F_[c] = Tensor::Identity() + gradients_[c];
    cofactor_[c] = cofactor(F_[c]);
    const double J = F_[c].determinant();
    push_[c] = push_of(finite_[c], J);
    pressure_at_[c] = pressure_.mean(c);
  });
  set_bonded_laws(law);
  for (std::size_t i = 0; pressure_.any() && i < sides_.size(); ++i)
    if (!has_polygon(i))
      moved_faces_.set_area(links_.size() + i, finite_at(sides_[i].cell, turn_of_side(i)).cofactor * sides_[i].n);
  pressed_faces_.linearise(t, u, gradients_, g);
  set_face_tensors();
  find_area_changes();
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
    sector_stress_[c] = across.dot(stresses_[c] * across);
    if (pressure_.any())
      sector_stress_[c] +=
          pressure_.mean(c) * moved_faces_.section(c) + pressure_at_[c] * moved_faces_.section_change(c, corner_moves_);
  });
  parallel_for(static_cast<Index>(bonded_laws_.size()), [&](Index k) {
    BondedLaw& by = bonded_laws_[as_size(k)];
    const Tensor& H = bonded_gradients_[as_size(k)];
    by.stress = from_components(by.law.A * to_components(H));
    by.cofactor_change = cofactor_change(by.F, H);
    by.volume_rate = contract(by.cofactor, H);
  });
}

void MomentumOperator::find_initial_sector_stress() {
  const Vector& across = unknowns_.plane_normal;
  parallel_for(sector_stress_.size(), [&](Index c) {
    const double pressure = pressure_.any() ? pressure_at_[c] * moved_faces_.section(c) : 0.0;
    initial_sector_[c] = across.dot(finite_[c].stress * across) + pressure - sector_stress_[c];
  });
}

// Before the first linearisation.
void MomentumOperator::place_moved_faces() {
  flux_.resize(forces_.size());
  moved_.resize(links_.size());
  area_changes_.resize(forces_.size());
  bonded_ = BondedSides(mesh_, unknowns_, sides_, [](Index) { return true; });  // also those of cubic faces
  bonded_gradients_.resize(bonded_.size());
  bonded_laws_.resize(bonded_.size());
  moved_faces_ = MovedFaces(mesh_, unknowns_, places_by_force(), bonded_);
}

// Whether the pressure acts on the polygon of a side; if not, on cof F N.
bool MomentumOperator::has_polygon(std::size_t side) const {
  const Side& of = sides_[side];
  const CellShape shape = mesh_.shape[of.cell];
  if (bonded_.number(side) >= 0) return false;
  const bool joins = second_side_of_node_[as_size(of.node - unknowns_.n_cells)] >= 0;
  return joins || (shape != CellShape::hexahedron && shape != CellShape::wedge);
}

void MomentumOperator::find_area_changes() const {
  parallel_for(static_cast<Index>(area_changes_.size()), [&](Index i) {
    const std::size_t n_links = links_.size(), k = as_size(i);
    if (k < n_links || has_polygon(k - n_links)) {
      area_changes_[k] = moved_faces_.area_change(k, corner_moves_);
      return;
    }
    const Side& side = sides_[k - n_links];
    const Index b = bonded_.number(k - n_links);
    area_changes_[k] = (b < 0 ? cofactor_change(F_[side.cell], gradients_[side.cell])
                              : cofactor_change(bonded_laws_[as_size(b)].F, bonded_gradients_[as_size(b)])) *
                       side.n;
  });
}

void MomentumOperator::set_bonded_laws(const FiniteLawAt& law) {
  parallel_for(static_cast<Index>(bonded_laws_.size()), [&](Index k) {
    BondedLaw& by = bonded_laws_[as_size(k)];
    const Tensor& H = bonded_gradients_[as_size(k)];
    by.law = law(sides_[bonded_.side(as_size(k))].cell, H);
    by.F = Tensor::Identity() + H;
    by.cofactor = cofactor(by.F);
    by.push = push_of(by.law, by.F.determinant());
  });
}

Vector MomentumOperator::true_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn) const {
  const Vector t = finite_at(cell, turn).true_stress * n;
  return pressure_.any() ? (t + pressure_.at(cell, d) * moved_faces_.area(force_at(turn))).eval() : t;
}

// m and dm/dJ are those of the face.
MomentumOperator::FaceTurn MomentumOperator::face_turn(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                                       const Push& m, const Vector& y) const {
  const FiniteAt at = finite_at(cell, turn);
  const Vector c = at.cofactor * n;
  FaceTurn by{.turn = turn_of(m.stiffness, c, y),
              .swell = m.slope * c.dot(y) * c,
              .initial = (at.true_stress - at.stress) * n,
              .pressure = pressure_.at(cell, d)};
  by.initial -= by.turn * (at.cofactor_change * n) + by.swell * at.volume_rate;
  if (pressure_.any()) by.initial -= by.pressure * area_changes_[force_at(turn)];
  return by;
}

void MomentumOperator::turn_link(std::size_t i, const std::vector<Vector>& u) {
  const Link& link = links_[i];
  const LinkTensors& by = link_tensors_[i];
  const Vector jump =
      u[as_size(link.N)] + gradients_[link.N] * link.d_N - u[as_size(link.P)] - gradients_[link.P] * link.d_P;
  const Vector step =
      true_traction(link.N, link.n, link.d_N, turn_N(i)) - true_traction(link.P, link.n, link.d_P, turn_P(i));
  const Vector y_P = by.weight.transpose() * jump + by.softness * step, y_N = jump - y_P;
  const double h_P = std::abs(link.d_P.dot(link.n)), h_N = std::abs(link.d_N.dot(link.n));
  face_turns_[turn_P(i)] = face_turn(link.P, link.n, link.d_P, turn_P(i), push_[link.P] / h_P, y_P);
  face_turns_[turn_N(i)] = face_turn(link.N, link.n, link.d_N, turn_N(i), push_[link.N] / h_N, y_N);
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
  const std::size_t turn = turn_of_side(i);
  const Vector gap = u[as_size(side.node)] - u[as_size(side.cell)] - rise(side.cell, side.d, turn);
  const Push m = side_push(i) / std::abs(side.d.dot(side.n));
  face_turns_[turn] = face_turn(side.cell, side.n, side.d, turn, m, gap);
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
  return capped(jump_share_[cell], finite_[cell], push_[cell]);
}

MomentumOperator::Push MomentumOperator::side_push(std::size_t i) const {
  const Side& side = sides_[i];
  const Index k = bonded_at(turn_of_side(i));
  if (k < 0) return capped_push(side.cell);
  const BondedLaw& by = bonded_laws_[as_size(k)];
  const Push single = capped(jump_share_[side.cell], by.law, by.push);
  return {BondedSides::stiffer * single.stiffness, BondedSides::stiffer * single.slope};
}

// a h
Tensor MomentumOperator::side_acoustic(std::size_t i) const {
  const Side& side = sides_[i];
  const Index k = bonded_at(turn_of_side(i));
  if (k < 0) return capped_acoustic(side.cell, side.n);
  const BondedLaw& by = bonded_laws_[as_size(k)];
  return pushed_forward(BondedSides::stiffer * by.law.face.mu, side_push(i).stiffness, by.cofactor * side.n);
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

// Of the displacements of faces, those of links being in moved_.
void MomentumOperator::find_finite_fluxes(const std::vector<Vector>& u) const {
  parallel_for(static_cast<Index>(flux_.size()), [&](Index i) {
    const std::size_t k = as_size(i), n_links = links_.size();
    flux_[k] = moved_faces_.flux(k, corner_moves_, k < n_links ? moved_[k] : u[as_size(sides_[k - n_links].node)],
                                 area_changes_[k]);
  });
}

double MomentumOperator::flux_out_of(Index cell) const {
  double sum = 0.0;
  for (std::size_t j = cell_offsets_[as_size(cell)]; j < cell_offsets_[as_size(cell) + 1]; ++j)
    sum += cell_forces_[j].sign * flux_[as_size(cell_forces_[j].force)];
  return sum;
}

// V J(q) - the volume of the moved cell, linearised.
void MomentumOperator::balance_finite_pressures(const std::vector<Vector>& u, std::vector<Vector>& out) const {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  if (cells.empty()) return;
  find_finite_fluxes(u);
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    const double rate = mesh_.cell_volume[c] * volume_rows_[as_size(k)].slope * pressure_.mean(c) - flux_out_of(c);
    out[as_size(unknowns_.n_nodes() + k)] = rate * Vector::UnitX();
  });
}

// J - 1 of the cells with a pressure [-], of faces that have moved by u_face, in the order of the forces.
CellField<double> MomentumOperator::swept_changes(const std::vector<Vector>& u_face) const {
  parallel_for(static_cast<Index>(flux_.size()),
               [&](Index i) { flux_[as_size(i)] = moved_faces_.swept(as_size(i), corner_moves_, u_face[as_size(i)]); });
  CellField<double> change(as_size(mesh_.n_cells()), 0.0);
  for (const Index c : unknowns_.pressure_cells) change[c] = flux_out_of(c) / mesh_.cell_volume[c];
  return change;
}

void MomentumOperator::find_initial_volumes(const std::vector<Vector>& u) {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  volume_rows_.resize(cells.size());
  compute_linear_forces(u);
  std::vector<Vector> u_face(forces_.size());
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) {
    const Vector jump = face_turns_[turn_N(as_size(i))].initial - face_turns_[turn_P(as_size(i))].initial;
    u_face[as_size(i)] = moved_[as_size(i)] + link_tensors_[as_size(i)].softness * jump;
  });
  for (std::size_t i = 0; i < sides_.size(); ++i) u_face[links_.size() + i] = u[as_size(sides_[i].node)];
  moved_faces_.follow(u_face);
  const CellField<double> change = swept_changes(u_face);
  find_finite_fluxes(u);
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    const VolumeAt volume = finite_[c].volume(pressure_at_[c]);
    const double linear = flux_out_of(c) / mesh_.cell_volume[c];
    volume_rows_[as_size(k)] = {.slope = volume.slope,
                                .initial = volume.change - volume.slope * pressure_at_[c] - change[c] + linear};
  });
}

void MomentumOperator::find_finite_pressure_forces(const CellField<double>& q) const {
  const auto n_links = static_cast<Index>(links_.size());
  parallel_for(n_links, [&](Index i) {
    const Link& link = links_[as_size(i)];
    const Vector& area = moved_faces_.area(as_size(i));
    forces_[as_size(i)] = link.area * (q[link.N] * area + weigh(as_size(i), (q[link.P] - q[link.N]) * area));
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    forces_[as_size(n_links + i)] = (side.area * q[side.cell]) * moved_faces_.area(as_size(n_links + i));
  });
  parallel_for(sector_stress_.size(), [&](Index c) { sector_stress_[c] = q[c] * moved_faces_.section(c); });
}

}  // namespace pfdm
