#include "solver/fracture/cell_stiffness.h"

#include "mesh/mesh_part.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Step of a cell whose strain oscillates. It recovers slowly: broken cells between two loose halves would oscillate
// again at once.
constexpr float least_share = 1.0F / 256.0F, recovery = 1.05F;

}  // namespace

CellStiffness::CellStiffness(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh), model_(model), endochronic_(mesh, model) {}

void CellStiffness::start_step(double duration) {
  endochronic_.start_step(duration);
  const auto n = as_size(mesh_.n_cells());
  if (model_.split->secant != nullptr) {
    closing_ = CellField<float>(n, 0.0F);
    turns_ = CellField<Index>(n, 0);
  } else {
    move_ = CellField<Tensor>(n);
    share_ = CellField<float>(n, 1.0F);
  }
}

void CellStiffness::take_out_memory(const CellStiffness& whole, const std::vector<Index>& cells) {
  closing_ = take_out(whole.closing_, cells);
  turns_ = take_out(whole.turns_, cells);
  move_ = take_out(whole.move_, cells);
  share_ = take_out(whole.share_, cells);
}

void CellStiffness::put_back_memory(const CellStiffness& part, const std::vector<Index>& cells) {
  put_back(part.closing_, cells, closing_);
  put_back(part.turns_, cells, turns_);
  put_back(part.move_, cells, move_);
  put_back(part.share_, cells, share_);
}

const IsotropicElasticity& CellStiffness::elasticity(Index cell) const {
  return model_.in_cell(mesh_, cell).elasticity;
}

double CellStiffness::factor(Index cell, double d) const {
  const RegionModel& region = model_.in_cell(mesh_, cell);
  if (!region.damageable) return 1.0;
  return (1.0 - model_.residual_stiffness) * model_.degradation->g(d, region.rational) + model_.residual_stiffness;
}

void CellStiffness::set(const FractureState& state, MomentumSolver& momentum) const {
  const auto n = as_size(mesh_.n_cells());
  CellField<double> g(n);
  parallel_for(mesh_.n_cells(), [&](Index c) { g[c] = factor(c, state.damage[c]); });
  if (model_.split->secant != nullptr) {
    CellField<IsotropicElasticity> moduli(n);
    parallel_for(mesh_.n_cells(),
                 [&](Index c) { moduli[c] = model_.split->secant(elasticity(c), g[c], state.closure[c]); });
    momentum.set_moduli(moduli, g);
    if (endochronic_.any()) momentum.set_stress(linearised(state, g, moduli));
  } else {
    CellField<MandelMatrix> stiffness(n);
    parallel_for(mesh_.n_cells(), [&](Index c) {
      stiffness[c] = degraded_tangent(*model_.split, elasticity(c), g[c], state.tangent_strain[c]);
    });
    momentum.set_stiffness(std::move(stiffness), g);
  }
}

// What the split keeps beyond g times the stiffness is elastic.
CellField<LinearStress> CellStiffness::linearised(const FractureState& state, const CellField<double>& g,
                                                  const CellField<IsotropicElasticity>& moduli) const {
  CellField<LinearStress> stress(as_size(mesh_.n_cells()));
  parallel_for(mesh_.n_cells(), [&](Index c) {
    stress[c].C = stiffness_matrix(moduli[c]);
    if (!endochronic_.has(c)) return;
    const LinearStress effective = endochronic_.linearised(c, state.endochronic[c]);
    stress[c].C += g[c] * (effective.C - stiffness_matrix(elasticity(c)));
    stress[c].initial = g[c] * effective.initial;
  });
  return stress;
}

double CellStiffness::integrate(const CellMechanics& mechanics, const FractureState& start, FractureState& state) {
  if (!endochronic_.any()) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    if (!endochronic_.has(c)) return 0.0;
    const double wrong =
        endochronic_.advance(c, mechanics.reconstructed_strain[c], start.endochronic[c], state.endochronic[c]);
    return factor(c, state.damage[c]) * wrong * mesh_.cell_volume[c];
  });
}

double CellStiffness::driving_energy(Index cell, const Tensor& strain, const FractureState& state) const {
  if (endochronic_.has(cell)) return endochronic_.driving_energy(cell, state.endochronic[cell]);
  return model_.split->energy(elasticity(cell), strain).psi_plus;
}

// Half the work on the elastic strain, and the energy of the kernel.
double CellStiffness::stored_energy(Index cell, const CellMechanics& mechanics, const FractureState& state) const {
  if (!endochronic_.has(cell)) return mechanics.energy[cell];
  const EndochronicState& history = state.endochronic[cell];
  const double on_plastic_strain = 0.5 * to_mandel(mechanics.stress[cell]).dot(history.plastic_strain);
  const double of_kernel = endochronic_.kernel_energy(cell, history, factor(cell, state.damage[cell]));
  return mechanics.energy[cell] + mesh_.cell_volume[cell] * (of_kernel - on_plastic_strain);
}

double CellStiffness::residual_energy(Index cell, double psi_plus, double d) const {
  const RegionModel& region = model_.in_cell(mesh_, cell);
  if (!region.damageable) return 0.0;
  const double lost = 1.0 - model_.degradation->g(d, region.rational);
  return model_.residual_stiffness * lost * psi_plus * mesh_.cell_volume[cell];
}

double CellStiffness::plastic_dissipation(const FractureState& from, const FractureState& to) const {
  if (!endochronic_.any()) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    const double g = 0.5 * (factor(c, from.damage[c]) + factor(c, to.damage[c]));
    return g * mesh_.cell_volume[c] * (to.endochronic[c].dissipation - from.endochronic[c].dissipation);
  });
}

double CellStiffness::follow(const CellField<Tensor>& strain, FractureState& state) {
  const bool isotropic = model_.split->secant != nullptr;
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    if (held_.size() > 0 && held_[c] != 0) return 0.0;
    return isotropic ? follow_with_closure(c, strain[c], state.damage[c], state.closure[c])
                     : follow_with_tangent(c, strain[c], state.damage[c], state.tangent_strain[c]);
  });
}

// The closure follows the strain with steps that shorten at each reversal. With full steps, cells at the edge of a
// crack would open and close alternately without converging.
double CellStiffness::follow_with_closure(Index cell, const Tensor& strain, double d, double& closure) {
  const double lag = model_.split->closure(strain) - closure;
  if (lag == 0.0) return 0.0;
  const double g = factor(cell, d);
  const double wrong = energy_density(model_.split->secant(elasticity(cell), g, closure + lag), strain) -
                       energy_density(model_.split->secant(elasticity(cell), g, closure), strain);
  if (lag * closing_[cell] < 0.0) ++turns_[cell];
  closing_[cell] = static_cast<float>(lag);
  // The kept fraction of the stiffness ranges from g to 1, over decades: steps are taken in its logarithm.
  const double step = 1.0 / (1.0 + turns_[cell]);
  const double kept = g + closure * (1.0 - g), wanted = lag > 0.0 ? 1.0 : g;
  const double next = std::pow(kept, 1.0 - step) * std::pow(wanted, step);
  const bool there = std::abs(next / wanted - 1.0) < 1e-3 || g == 1.0;
  closure = there ? closure + lag : (next - g) / (1.0 - g);
  return mesh_.cell_volume[cell] * std::abs(wrong);
}

// Newton's step; a cell whose strain oscillates takes a fraction of it that decreases with each reversal.
double CellStiffness::follow_with_tangent(Index cell, const Tensor& strain, double d, Tensor& tangent_strain) {
  const double g = factor(cell, d);
  if (g == 1.0) return 0.0;
  const Mandel eps = to_mandel(strain);
  const double used = eps.dot(degraded_tangent(*model_.split, elasticity(cell), g, tangent_strain) * eps);
  const double due = eps.dot(degraded_tangent(*model_.split, elasticity(cell), g, strain) * eps);
  const Tensor move = strain - tangent_strain;
  const bool turned = contract(move, move_[cell]) < 0.0;
  share_[cell] = turned ? std::max(0.5F * share_[cell], least_share) : std::min(recovery * share_[cell], 1.0F);
  move_[cell] = move;
  tangent_strain += static_cast<double>(share_[cell]) * move;
  return 0.5 * mesh_.cell_volume[cell] * std::abs(due - used);
}

}  // namespace pfdm
