#include "solver/momentum/finite_strain/finite_states.h"

#include "solver/momentum/faces/acoustic_tensor.h"
#include "solver/momentum/faces/polyhedral_jump.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

Tensor pushed_forward(double mu, double m, const Vector& c) { return mu * Tensor::Identity() + m * c * c.transpose(); }

// 1/J^2, where J < 1/2 its tangent there: a has to be finite and positive definite for every F.
double swelling(double J) { return J > 0.5 ? 1.0 / (J * J) : 12.0 - 16.0 * J; }
double swelling_slope(double J) { return J > 0.5 ? -2.0 / (J * J * J) : -16.0; }

FiniteStates::Change change_by(const Tensor& H, const FiniteLaw& law, const Tensor& F, const Tensor& cofactor) {
  return {.stress = from_components(law.A * to_components(H)),
          .cofactor = cofactor_change(F, H),
          .volume = contract(cofactor, H)};
}

}  // namespace

FiniteStates::FiniteStates(const FaceSkeleton& skeleton, const LayerGradients& layers)
    : skeleton_(skeleton),
      laws_(skeleton.mesh.n_cells()),
      F_(skeleton.mesh.n_cells()),
      cofactor_(skeleton.mesh.n_cells()),
      push_(skeleton.mesh.n_cells()),
      jump_share_(jump_shares(skeleton.mesh, skeleton.unknowns)),
      bonded_(skeleton.mesh, skeleton.unknowns, skeleton.sides, [&](Index c) { return !layers.cover(c); }) {
  for (std::size_t k = 0; k < bonded_.size(); ++k) own_sides_.push_back(bonded_.side(k));
  for (const std::size_t turn : layers.surface_sides()) own_sides_.push_back(side_at(turn));
  if (!own_sides_.empty()) own_of_side_.assign(skeleton.sides.size(), -1);
  for (std::size_t k = 0; k < own_sides_.size(); ++k) own_of_side_[own_sides_[k]] = static_cast<Index>(k);
  side_states_.resize(own_sides_.size());
}

void FiniteStates::extrapolate(const LayerGradients& layers, const CellField<Mandel>& eigenstrains) {
  relative_.clear();
  if (eigenstrains.size() == 0 || !layers.any()) return;
  relative_.assign(n_own(), Tensor::Identity());
  layers.extrapolate([&](std::size_t turn, Index cell, Index behind, double part) {
    const Tensor of_cell = Tensor::Identity() + to_tensor(eigenstrains[cell]);
    const Tensor on_side = of_cell + part * to_tensor(eigenstrains[cell] - eigenstrains[behind]);
    relative_[own_at(turn)] = on_side.inverse() * of_cell;
  });
}

std::vector<Index> FiniteStates::cells_of_own() const {
  std::vector<Index> cells;
  for (const std::size_t side : own_sides_) cells.push_back(skeleton_.sides[side].cell);
  return cells;
}

Tensor FiniteStates::as_law_sees(std::size_t own, const Tensor& H) const {
  if (relative_.empty()) return H;
  return (Tensor::Identity() + H) * relative_[own] - Tensor::Identity();
}

// With K as `relative_`, P(F) = P_cell(F K) K^T / det K.
FiniteLaw FiniteStates::law_on_side(const FiniteLawAt& law, std::size_t own, const Tensor& H) const {
  const Index cell = skeleton_.sides[own_sides_[own]].cell;
  FiniteLaw at = law(cell, static_cast<Index>(own), as_law_sees(own, H));
  if (relative_.empty()) return at;
  const Tensor& K = relative_[own];
  const double volume = K.determinant();
  GradientTangent times_K;
  for (Index i = 0; i < 9; ++i) times_K.col(i) = to_components(from_components(Components::Unit(i)) * K);
  at.stress = at.stress * K.transpose() / volume;
  at.A = times_K.transpose() * at.A * times_K / volume;
  at.free_change = (1.0 + at.free_change) / volume - 1.0;
  return at;
}

FiniteStates::Push FiniteStates::push_of(const FiniteLaw& law, double J) {
  const double mu = law.swelling * law.face.mu;
  return {law.face.lambda + mu * swelling(J), mu * swelling_slope(J)};
}

// Stiffness m of polyhedra, capped to this share of lambda + 2 mu.
FiniteStates::Push FiniteStates::capped(double share, const FiniteLaw& law, const Push& push) {
  const double mu = law.swelling * law.face.mu;
  return {share * (push.stiffness + mu) - mu, share * push.slope};
}

void FiniteStates::linearise(const FiniteLawAt& law, const CellField<Tensor>& gradients,
                             const std::vector<Tensor>& on_sides) {
  parallel_for(laws_.size(), [&](Index c) {
    laws_[c] = law(c, -1, gradients[c]);
    F_[c] = Tensor::Identity() + gradients[c];
    cofactor_[c] = cofactor(F_[c]);
    push_[c] = push_of(laws_[c], F_[c].determinant());
  });
  parallel_for(count_of(side_states_), [&](Index k) {
    SideState& at = side_states_[k];
    const Tensor& H = on_sides[k];
    at.law = law_on_side(law, k, H);
    at.F = Tensor::Identity() + H;
    at.cofactor = cofactor(at.F);
    at.push = push_of(at.law, at.F.determinant());
  });
}

void FiniteStates::find_changes(const CellField<Tensor>& gradients, const std::vector<Tensor>& on_sides,
                                Changes& changes) const {
  parallel_for(laws_.size(),
               [&](Index c) { changes.of_cell[c] = change_by(gradients[c], laws_[c], F_[c], cofactor_[c]); });
  parallel_for(count_of(side_states_), [&](Index k) {
    const SideState& at = side_states_[k];
    changes.on_side[k] = change_by(on_sides[k], at.law, at.F, at.cofactor);
  });
}

FiniteStates::Push FiniteStates::side_push(std::size_t i) const {
  const momentum_faces::Side& side = skeleton_.sides[i];
  const Index k = own(i);
  if (k < 0) return capped_push(side.cell);
  const SideState& at = side_states_[k];
  const Push single = capped(jump_share_[side.cell], at.law, at.push);
  return {stiffer(i) * single.stiffness, stiffer(i) * single.slope};
}

FiniteStates::Push FiniteStates::memory_push(Index cell, std::size_t turn) const {
  const Index k = own_at(turn);
  const FiniteLaw& law = law_at(cell, turn);
  const double J = (k < 0 ? F_[cell] : side_states_[k].F).determinant(), share = jump_share_[cell];
  const double m = law.memory.lambda + law.swelling * swelling(J);
  return {share * (m + 1.0) - 1.0, share * law.swelling * swelling_slope(J)};
}

Tensor FiniteStates::acoustic(Index cell, const Vector& n) const {
  return pushed_forward(laws_[cell].face.mu, push_[cell].stiffness, cofactor_[cell] * n);
}

Tensor FiniteStates::capped_acoustic(Index cell, const Vector& n) const {
  return pushed_forward(laws_[cell].face.mu, capped_push(cell).stiffness, cofactor_[cell] * n);
}

Tensor FiniteStates::side_acoustic(std::size_t i) const {
  const momentum_faces::Side& side = skeleton_.sides[i];
  const Index k = own(i);
  if (k < 0) return capped_acoustic(side.cell, side.n);
  const SideState& at = side_states_[k];
  return pushed_forward(stiffer(i) * at.law.face.mu, side_push(i).stiffness, at.cofactor * side.n);
}

double FiniteStates::stiffness_difference(const momentum_faces::Link& link) const {
  const double mu_P = laws_[link.P].face.mu, mu_N = laws_[link.N].face.mu;
  return 1.0 - std::min(mu_P, mu_N) / std::max(mu_P, mu_N);
}

Tensor FiniteStates::jump_tensor(const momentum_faces::Link& link, double h_P, double h_N) const {
  Tensor full = in_series(acoustic(link.P, link.n), h_P, acoustic(link.N, link.n), h_N);
  if (!is_capped(link)) return full;
  const Tensor small = in_series(capped_acoustic(link.P, link.n), h_P, capped_acoustic(link.N, link.n), h_N);
  return small + stiffness_difference(link) * (full - small);
}

CellField<double> FiniteStates::face_stiffness() const {
  CellField<double> measure(laws_.size());
  parallel_for(laws_.size(), [&](Index c) {
    measure[c] = 3.0 * laws_[c].face.mu + push_[c].stiffness * cofactor_[c].squaredNorm() / 3.0;
  });
  return measure;
}

}  // namespace pfdm
