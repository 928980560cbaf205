#include "solver/momentum/small_strain/law_tractions.h"

#include "physics/elasticity/plane_stress.h"
#include "solver/momentum/faces/acoustic_tensor.h"
#include "solver/parallel.h"

namespace pfdm {

using momentum_faces::bounded_height;
using momentum_faces::Link;
using momentum_faces::Side;

namespace {

// The part of the stiffness that damage degrades. Its energy is never negative, but for rounding.
struct LawPart {
  const StrainLaw& law;
  Index cell;
  Tensor of_cell(const Tensor& strain) const { return law.degradable(cell, strain); }
  Tensor at_face(const Tensor& strain) const { return of_cell(strain); }
  double least(double) const { return 0.0; }
};

}  // namespace

LawTractions::SideLaw LawTractions::law_of_cell(Index c, const Vector& n) const {
  const Mandel initial = eigenstrain_.any() ? to_mandel(initial_stress_[c]) : Mandel(Mandel::Zero());
  return side_law_of(stiffness_[c], initial, n);
}

std::unique_ptr<Sweep> LawTractions::new_sweep() const {
  auto s = std::make_unique<LawSweep>(skeleton_);
  s->layers.assign(cells_.layers().has_lines() ? skeleton_.n_turns() : 0, Tensor::Zero());
  return s;
}

void LawTractions::reconstruct(const std::vector<Vector>& u, LawSweep& s) const {
  cells_.find_gradients(u, s.gradients);
  if (cells_.layers().any()) cells_.layers().correct(u, s.gradients, s.layers);
}

void LawTractions::find_linear(const std::vector<Vector>& u, Sweep& sweep) const {
  LawSweep& s = of(sweep);
  reconstruct(u, s);
  const Vector& across = plane_normal();
  parallel_for(s.sector_stress.size(), [&](Index c) {
    s.sector_stress[c] = across.dot(to_tensor(stiffness_[c] * to_mandel(symmetric_part(s.gradients[c]))) * across);
  });
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Link& link = skeleton_.links[i];
    const Tensor &G_P = s.gradients[link.P], &G_N = s.gradients[link.N];
    const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
    const Vector stress_P = linear_traction(P, gradient_at(link.P, P, s));
    const Vector stress_N = linear_traction(N, gradient_at(link.N, N, s));
    const Vector u_P = u[link.P] + G_P * link.d_P;
    const Vector jump = u[link.N] + G_N * link.d_N - u_P + leaned(i, G_N - G_P);
    const auto& by = link_tensors_[i];
    s.force[i] = link.area * (stress_N + by.weight * (stress_P - stress_N) + by.c * weighed(i, jump));
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const Side& side = skeleton_.sides[i];
    const std::size_t turn = skeleton_.turn_of_side(i);
    const Vector gap = u[side.node] - u[side.cell] - s.gradients[side.cell] * side.d;
    const Vector stress = linear_traction(turn, gradient_at(side.cell, turn, s));
    s.force[n_links + i] = side.area * (stress + side_tensors_[i] * gap);
  });
}

bool LawTractions::add_constant(Sweep& s) const {
  if (!eigenstrain_.any()) return false;
  const auto n_links = count_of(skeleton_.links);
  parallel_for(n_links, [&](Index i) {
    const Vector &on_P = side_laws_[FaceSkeleton::turn_P(i)].initial,
                 &on_N = side_laws_[FaceSkeleton::turn_N(i)].initial;
    s.force[i] += skeleton_.links[i].area * (on_N + link_tensors_[i].weight * (on_P - on_N));
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    s.force[n_links + i] += skeleton_.sides[i].area * side_laws_[skeleton_.turn_of_side(i)].initial;
  });
  const Vector& across = plane_normal();
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] += across.dot(initial_stress_[c] * across); });
  return true;
}

// (a + b)^-1 b is the transpose of P's weight.
Vector LawTractions::link_displacement(std::size_t i, const std::vector<Vector>& u, const Sweep& sweep) const {
  const LawSweep& s = of(sweep);
  const Link& link = skeleton_.links[i];
  const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
  const Tensor &G_P = s.gradients[link.P], &G_N = s.gradients[link.N];
  const Vector from_P = u[link.P] + G_P * link.d_P;
  const Vector from_N = u[link.N] + G_N * link.d_N;
  Vector stress_jump = linear_traction(N, gradient_at(link.N, N, s)) - linear_traction(P, gradient_at(link.P, P, s));
  if (eigenstrain_.any()) stress_jump += side_laws_[N].initial - side_laws_[P].initial;
  const Vector towards_N = link_tensors_[i].weight.transpose() * (from_N - from_P);
  return from_P + towards_N + link_tensors_[i].softness * stress_jump;
}

Tensor LawTractions::compact_link(std::size_t i) const {
  const Link& link = skeleton_.links[i];
  const double h_P = bounded_height(link.d_P, link.n), h_N = bounded_height(link.d_N, link.n);
  return link.area * in_series(side_laws_[FaceSkeleton::turn_P(i)].acoustic, h_P,
                               side_laws_[FaceSkeleton::turn_N(i)].acoustic, h_N);
}

Tensor LawTractions::compact_side(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  return (side.area / bounded_height(side.d, side.n)) * side_laws_[skeleton_.turn_of_side(i)].acoustic;
}

double LawTractions::hoop_modulus(Index cell) const {
  return plane_normal().dot(acoustic_tensor(stiffness_[cell], plane_normal()) * plane_normal());
}

CellField<double> LawTractions::side_stiffness() const {
  CellField<double> sum(skeleton_.mesh.n_cells(), 0.0);
  std::vector<Index> number(skeleton_.mesh.n_cells(), 0);
  const auto add = [&](Index cell, std::size_t turn) {
    sum[cell] += side_laws_[turn].acoustic.trace();
    ++number[cell];
  };
  for (std::size_t i = 0; i < skeleton_.links.size(); ++i) {
    add(skeleton_.links[i].P, FaceSkeleton::turn_P(i));
    add(skeleton_.links[i].N, FaceSkeleton::turn_N(i));
  }
  for (std::size_t i = 0; i < skeleton_.sides.size(); ++i) add(skeleton_.sides[i].cell, skeleton_.turn_of_side(i));
  for (Index c = 0; c < sum.size(); ++c) sum[c] /= static_cast<double>(number[c]);
  return sum;
}

Tensor LawTractions::with_strain_across(Index cell, const Tensor& gradient) const {
  if (!is_plane_stress()) return gradient;
  return gradient - symmetric_part(gradient) + law_at(cell, symmetric_part(gradient)).strain;
}

double LawTractions::stress_across(Index cell, const Tensor& strain, const Sweep&) const {
  if (is_plane_stress()) return 0.0;
  const Tensor elastic = eigenstrain_.elastic_part(cell, strain);
  const Mandel stress = law_.tangent(cell, elastic) * to_mandel(elastic);
  return plane_normal().dot(to_tensor(stress) * plane_normal());
}

// The part of the jump at a link without weight that the face's displacement has beyond a cell's gap [m].
Vector LawTractions::idle(std::size_t turn, const FaceMoves& moves) const {
  if (skeleton_.is_side(turn) || !cells_.layers().weighs(turn / 2)) return Vector::Zero();
  const std::size_t i = turn / 2;
  const Link& link = skeleton_.links[i];
  const CellField<Tensor>& G = moves.sweep.gradients;
  const Vector jump = moves.u[link.N] + G[link.N] * link.d_N - moves.u[link.P] - G[link.P] * link.d_P;
  const Vector rest = jump - weighed(i, jump);
  return FaceSkeleton::idle_share(turn, rest, link_tensors_[i].weight.transpose() * rest);
}

// Splits of the regions may differ in kind: an isotropic part is that of cells with secant moduli.
double LawTractions::energy_of_part(Index cell, const IsotropicElasticity& part, const Tensor& strain,
                                    const FaceMoves& moves) const {
  const LawSweep& s = of(moves.sweep);
  const auto at = [&](std::size_t turn, const Vector& d, const Vector& n, const Vector& move) -> Tensor {
    const Vector gap = move - s.gradients[cell] * d - idle(turn, moves);
    return gradient_at(cell, turn, s) + gap * n.transpose() / bounded_height(d, n);
  };
  return part.mu > 0.0 ? energy_over_faces(cell, with_jump_modulus(cell, part), strain, moves, at)
                       : energy_over_faces(cell, LawPart{law_, cell}, strain, moves, at);
}

}  // namespace pfdm
