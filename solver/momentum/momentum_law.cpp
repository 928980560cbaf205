// Cells whose stress is a function of the strain (momentum.h), by faces. With y_P = u_f - u_P - G_P d_P and
// y_N = u_N + G_N d_N - u_f on the two sides of a face, the strains there are
//
//   eps_P = sym(G_P + y_P n^T/h_P),  eps_N = sym(G_N + y_N n^T/h_N),
//
// and u_f is where sigma(eps_P) n = sigma(eps_N) n: the least of h_P psi(eps_P) + h_N psi(eps_N), which is convex. It
// is found face by face, so that the tractions are continuous functions of the displacements. Linear ones about a
// strain of the cell's own jump where one of its principal strains changes sign, and have no equilibrium there.

#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

namespace pfdm {
namespace {

momentum_faces::SideLaw side_law_of(const MandelMatrix& C, const Mandel& initial, const Vector& n) {
  Eigen::Matrix<double, 6, 3> strain;
  for (Index k = 0; k < 3; ++k) strain.col(k) = to_mandel(symmetric_part(Vector::Unit(k) * n.transpose()));
  const Eigen::Matrix<double, 3, 6> rows = strain.transpose() * C;
  return {.rows = rows, .acoustic = rows * strain, .initial = to_tensor(initial) * n};
}

Tensor stretched(const Tensor& G, const Vector& y, const Vector& n, double h) {
  return symmetric_part(G + y * n.transpose() / h);
}

}  // namespace

void MomentumOperator::set_law(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u, bool afresh,
                               double part) {
  law_ = std::move(law);
  leave_out_third_order();
  gradient_.update(g, part);
  reconstruct(u);
  const auto n = as_size(mesh_.n_cells());
  const bool has_faces = !side_laws_.empty() && !afresh;
  stiffness_ = CellField<MandelMatrix>(n);
  if (has_eigenstrain()) initial_stress_ = CellField<Tensor>(n);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const AtStrain at = law_at(c, symmetric_part(gradients_[c]));
    stiffness_[c] = at.C;
    if (has_eigenstrain()) initial_stress_[c] = to_tensor(at.initial);
  });
  side_laws_.resize(2 * links_.size() + sides_.size());
  link_tensors_.resize(links_.size());
  side_tensors_.resize(sides_.size());
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) { settle_link(as_size(i), has_faces, u); });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    const double h = std::abs(side.d.dot(side.n));
    const Vector gap = u[as_size(side.node)] - u[as_size(side.cell)] - gradients_[side.cell] * side.d;
    side_laws_[turn_of_side(as_size(i))] =
        side_law(side.cell, stretched(gradients_[side.cell], gap, side.n, h), side.n);
    side_tensors_[as_size(i)] = side_laws_[turn_of_side(as_size(i))].acoustic / h;
  });
}

// In plane stress the stiffness is condensed, and the strain that with the one across at which nothing acts there.
MomentumOperator::AtStrain MomentumOperator::law_at(Index cell, const Tensor& strain) const {
  AtStrain at{.C = law_.tangent(cell, without_eigenstrain(cell, strain)), .strain = strain};
  const auto linear = [&] {
    return LinearStress{.C = at.C,
                        .initial = has_eigenstrain() ? Mandel(-(at.C * eigenstrain_[cell])) : Mandel(Mandel::Zero())};
  };
  at.initial = linear().initial;
  if (!unknowns_.plane_stress) return at;
  constexpr int most_steps = 30;
  constexpr double precise = 1e-14;
  const Vector& n = unknowns_.plane_normal;
  StrainAcross across;
  double before = 0.0;
  for (int k = 0; k < most_steps; ++k) {
    across = strain_across(linear(), n);
    const double now = across(to_mandel(strain));
    at.strain = strain + now * n * n.transpose();
    if (std::abs(now - before) <= precise * at.strain.norm()) break;
    before = now;
    at.C = law_.tangent(cell, without_eigenstrain(cell, at.strain));
  }
  const LinearStress condensed = plane_stress(linear(), n);
  at.C = condensed.C;
  at.initial = condensed.initial;
  return at;
}

MomentumOperator::SideLaw MomentumOperator::side_law(Index cell, const Tensor& strain, const Vector& n) const {
  const AtStrain at = law_at(cell, strain);
  return side_law_of(at.C, at.initial, n);
}

// The tractions of both sides of a link, by y_P.
struct MomentumOperator::LinkBalance {
  const MomentumOperator& of;
  const Link& link;
  SideLaw &P, &N;
  Vector jump;
  double h_P, h_N;
  double negligible = 0.0;  // difference of the tractions that the last strains cannot tell from none [Pa]

  // The linear law of the last strains takes one more step, so that what is left of the difference squared remains.
  Vector unbalanced(const Vector& y) {
    constexpr double precise = 1e-8, rounding = 1e-16;
    const Tensor at_P = stretched(of.gradients_[link.P], y, link.n, h_P);
    const Tensor at_N = stretched(of.gradients_[link.N], jump - y, link.n, h_N);
    P = of.side_law(link.P, at_P, link.n);
    N = of.side_law(link.N, at_N, link.n);
    const Vector t_P = P.rows * to_mandel(at_P) + P.initial, t_N = N.rows * to_mandel(at_N) + N.initial;
    negligible =
        precise * (t_P.norm() + t_N.norm()) + rounding * (P.rows.norm() * at_P.norm() + N.rows.norm() * at_N.norm());
    return t_P - t_N;
  }
  Tensor softness() const { return (P.acoustic / h_P + N.acoustic / h_N).inverse(); }
  // Of the present tangents.
  Vector linear_answer() const {
    const Vector apart = N.rows * to_mandel(symmetric_part(of.gradients_[link.N])) -
                         P.rows * to_mandel(symmetric_part(of.gradients_[link.P])) + N.initial - P.initial;
    return softness() * (apart + N.acoustic * jump / h_N);
  }
};

// Newton's method; a step that leads beyond the least energy by more than half is shortened.
void MomentumOperator::settle_link(std::size_t i, bool has_faces, const std::vector<Vector>& u) {
  constexpr int most_steps = 50, most_cuts = 6;
  const Link& link = links_[i];
  const Vector jump =
      u[as_size(link.N)] + gradients_[link.N] * link.d_N - u[as_size(link.P)] - gradients_[link.P] * link.d_P;
  LinkBalance balance{.of = *this,
                      .link = link,
                      .P = side_laws_[turn_P(i)],
                      .N = side_laws_[turn_N(i)],
                      .jump = jump,
                      .h_P = std::abs(link.d_P.dot(link.n)),
                      .h_N = std::abs(link.d_N.dot(link.n))};
  if (!has_faces) {
    const auto of_cell = [&](Index c) {
      const Mandel initial = has_eigenstrain() ? to_mandel(initial_stress_[c]) : Mandel(Mandel::Zero());
      return side_law_of(stiffness_[c], initial, link.n);
    };
    balance.P = of_cell(link.P);
    balance.N = of_cell(link.N);
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
}

// By cell: of the faces' normal stiffness, the mean.
CellField<double> MomentumOperator::side_stiffness() const {
  CellField<double> sum(as_size(mesh_.n_cells()), 0.0);
  std::vector<Index> number(as_size(mesh_.n_cells()), 0);
  const auto add = [&](Index cell, std::size_t turn) {
    sum[cell] += side_laws_[turn].acoustic.trace();
    ++number[as_size(cell)];
  };
  for (std::size_t i = 0; i < links_.size(); ++i) add(links_[i].P, turn_P(i)), add(links_[i].N, turn_N(i));
  for (std::size_t i = 0; i < sides_.size(); ++i) add(sides_[i].cell, turn_of_side(i));
  for (Index c = 0; c < sum.size(); ++c) sum[c] /= static_cast<double>(number[as_size(c)]);
  return sum;
}

}  // namespace pfdm
