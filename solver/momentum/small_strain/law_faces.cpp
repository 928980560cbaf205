// Agreement of the two sides of each face (law_tractions.h).

#include "physics/elasticity/anisotropy.h"
#include "physics/elasticity/plane_stress.h"
#include "solver/momentum/small_strain/law_tractions.h"
#include "solver/parallel.h"

namespace pfdm {

using momentum_faces::Link;
using momentum_faces::Side;

namespace {

Tensor stretched(const Tensor& G, const Vector& y, const Vector& n, double h) {
  return symmetric_part(G + y * n.transpose() / h);
}

}  // namespace

LawTractions::SideLaw LawTractions::side_law_of(const MandelMatrix& C, const Mandel& initial, const Vector& n) {
  const Eigen::Matrix<double, 6, 3> strain = strains_across(n);
  const Eigen::Matrix<double, 3, 6> rows = strain.transpose() * C;
  return {.rows = rows, .acoustic = rows * strain, .initial = to_tensor(initial) * n};
}

void LawTractions::set(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u, bool afresh,
                       double part) {
  law_ = std::move(law);
  cells_.weigh(g, part);
  cells_.weigh_third_order(g);
  extrapolate_eigenstrains();
  const auto lease = sweep();
  LawSweep& s = of(*lease);
  reconstruct(u, s);
  const std::size_t n = skeleton_.mesh.n_cells();
  const bool has_faces = !side_laws_.empty() && !afresh;
  stiffness_ = CellField<MandelMatrix>(n);
  initial_stress_ = CellField<Tensor>(eigenstrain_.any() ? n : 0);
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    const AtStrain at = law_at(c, symmetric_part(s.gradients[c]));
    stiffness_[c] = at.C;
    if (eigenstrain_.any()) initial_stress_[c] = to_tensor(at.initial);
  });
  side_laws_.resize(skeleton_.n_turns());
  link_tensors_.resize(skeleton_.links.size());
  side_tensors_.resize(skeleton_.sides.size());
  parallel_for(count_of(link_tensors_), [&](Index i) { settle_link(i, has_faces, u, s); });
  parallel_for(count_of(side_tensors_), [&](Index i) { settle_side(i, u, s); });
}

void LawTractions::settle_side(std::size_t i, const std::vector<Vector>& u, const LawSweep& s) {
  const Side& side = skeleton_.sides[i];
  const std::size_t turn = skeleton_.turn_of_side(i);
  const Vector gap = u[side.node] - u[side.cell] - s.gradients[side.cell] * side.d;
  SideLaw& law = side_laws_[turn];
  law = side_law(side.cell, stretched(strain_at(side.cell, turn, s), gap, side.n, side.h()), side.n);
  set_free(law, turn);
  side_tensors_[i] = law.acoustic / side.h();
}

LinearStress LawTractions::linear_at(Index cell, const MandelMatrix& C) const {
  return {.C = C, .initial = eigenstrain_.any() ? Mandel(-(C * eigenstrain_[cell])) : Mandel(Mandel::Zero())};
}

// In plane stress the stiffness is condensed, and the strain that with the one across at which nothing acts there.
LawTractions::AtStrain LawTractions::law_at(Index cell, const Tensor& strain) const {
  AtStrain at{.C = law_.tangent(cell, eigenstrain_.elastic_part(cell, strain)), .strain = strain};
  at.initial = linear_at(cell, at.C).initial;
  if (!is_plane_stress()) return at;
  constexpr int most_steps = 30;
  constexpr double precise = 1e-14;
  const Vector& n = plane_normal();
  double before = 0.0;
  for (int k = 0; k < most_steps; ++k) {
    const double now = strain_across(linear_at(cell, at.C), n)(to_mandel(strain));
    at.strain = strain + now * n * n.transpose();
    if (std::abs(now - before) <= precise * at.strain.norm()) break;
    before = now;
    at.C = law_.tangent(cell, eigenstrain_.elastic_part(cell, at.strain));
  }
  const LinearStress condensed = plane_stress(linear_at(cell, at.C), n);
  at.C = condensed.C;
  at.initial = condensed.initial;
  return at;
}

LawTractions::SideLaw LawTractions::side_law(Index cell, const Tensor& strain, const Vector& n) const {
  const AtStrain at = law_at(cell, strain);
  return side_law_of(at.C, at.initial, n);
}

// The tractions of both sides of a link, by y_P.
struct LawTractions::LinkBalance {
  const LawTractions& of;
  const Link& link;
  const Tensor G_P, G_N;
  SideLaw &P, &N;
  Vector jump;
  double h_P, h_N;
  double negligible = 0.0;  // difference of the tractions that the last strains cannot tell from none [Pa]

  // The linear law of the last strains takes one more step, so that what is left of the difference squared remains.
  Vector unbalanced(const Vector& y) {
    constexpr double precise = 1e-8, rounding = 1e-16;
    const Tensor at_P = stretched(G_P, y, link.n, h_P);
    const Tensor at_N = stretched(G_N, jump - y, link.n, h_N);
    P = of.side_law(link.P, at_P, link.n);
    N = of.side_law(link.N, at_N, link.n);
    const Vector t_P = P.rows * to_mandel(at_P) + P.initial, t_N = N.rows * to_mandel(at_N) + N.initial;
    negligible =
        precise * (t_P.norm() + t_N.norm()) + rounding * (P.rows.norm() * at_P.norm() + N.rows.norm() * at_N.norm());
    return t_P - t_N;
  }
  Tensor softness() const { return (P.acoustic / h_P + N.acoustic / h_N).inverse(); }
  // Displacement of the face by the present tangents [m].
  Vector linear_answer() const {
    const Vector apart =
        N.rows * to_mandel(symmetric_part(G_N)) - P.rows * to_mandel(symmetric_part(G_P)) + N.initial - P.initial;
    return softness() * (apart + N.acoustic * jump / h_N);
  }
};

// Newton's method; a step that leads beyond the least energy by more than half is shortened.
void LawTractions::settle_link(std::size_t i, bool has_faces, const std::vector<Vector>& u, const LawSweep& s) {
  constexpr int most_steps = 50, most_cuts = 6;
  const Link& link = skeleton_.links[i];
  const std::size_t turn_P = FaceSkeleton::turn_P(i), turn_N = FaceSkeleton::turn_N(i);
  const Vector jump = u[link.N] + s.gradients[link.N] * link.d_N - u[link.P] - s.gradients[link.P] * link.d_P;
  LinkBalance balance{.of = *this,
                      .link = link,
                      .G_P = strain_at(link.P, turn_P, s),
                      .G_N = strain_at(link.N, turn_N, s),
                      .P = side_laws_[turn_P],
                      .N = side_laws_[turn_N],
                      .jump = weighed(i, jump),
                      .h_P = link.h_P(),
                      .h_N = link.h_N()};
  if (!has_faces) {
    balance.P = law_of_cell(link.P, link.n);
    balance.N = law_of_cell(link.N, link.n);
  }
  Vector y = balance.linear_answer(), rest = balance.unbalanced(y);
  for (int k = 0; k < most_steps && rest.norm() > balance.negligible; ++k) {
    Vector step = -(balance.softness() * rest);
    const Vector from = y, before = rest;
    for (int cut = 0; cut <= most_cuts; ++cut) {
      y = from + step;
      rest = balance.unbalanced(y);
      const double fall = -before.dot(step), rise = rest.dot(step);
      if (rise <= 0.5 * fall) break;
      step *= fall / (fall + rise);
    }
  }
  const Tensor softness = balance.softness(), weight = balance.N.acoustic / balance.h_N * softness;
  link_tensors_[i] = {
      .weight = weight, .c = symmetric_part(weight * balance.P.acoustic / balance.h_P), .softness = softness};
  set_free(balance.P, turn_P);
  set_free(balance.N, turn_N);
}

// Adds to the traction without strain that of an eigenstrain that is not the cell's.
void LawTractions::set_free(SideLaw& law, std::size_t turn) const {
  if (varies_eigenstrain()) law.initial -= law.rows * to_mandel(eigenstrain_change(turn));
}

}  // namespace pfdm
