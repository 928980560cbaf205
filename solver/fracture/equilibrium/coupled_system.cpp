#include "solver/fracture/equilibrium/coupled_system.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double damage_reduction = 0.1;  // of the residual, by conjugate gradients
constexpr Index most_damage_iterations = 50;

}  // namespace

CoupledSystem::CoupledSystem(MomentumSolver& momentum, const DamageEquation& damage,
                             CellField<IsotropicElasticity> part, const FractureState& state,
                             ConjugateGradients::Held held)
    : momentum_(momentum),
      damage_(damage),
      n_cells_(state.damage.size()),
      n_u_(state.displacement.size()),
      g_prime_(damage.stiffness_slopes(state.damage)),
      root_(n_cells_, 1.0),
      diagonal_(as_size(n_cells_), 1.0),
      r_d_(as_size(n_cells_)),
      z_d_(as_size(n_cells_)),
      held_(std::move(held)),
      by_damage_(damage.coupling()),
      dd_(n_cells_),
      dg_(n_cells_),
      energy_(n_cells_),
      by_mean_(n_cells_),
      u_(n_u_),
      force_(n_u_) {
  if (part.size() > 0) coupling_.emplace(momentum.balance(), std::move(part), state.displacement);
  parallel_for(n_cells_, [&](Index c) {
    if (!damage.is_damageable(c)) return;
    diagonal_[c] = damage.diagonal(c, state.damage[c], state.driving_energy[c]);
    root_[c] = std::sqrt(diagonal_[c]);
  });
}

std::vector<double> CoupledSystem::scale() const {
  std::vector<double> scale = momentum_.row_scale();
  scale.resize(size(), 1.0);
  return scale;
}

void CoupledSystem::add_damage(const std::vector<Vector>& x, std::vector<Vector>& y) {
  parallel_for(n_cells_, [&](Index c) { dd_[c] = of(x, c) / root_[c]; });
  const StiffnessDamage& by = damage_.stiffness_damage();
  const CellField<double> mean = by.means(dd_);
  parallel_for(n_cells_, [&](Index c) { dg_[c] = g_prime_[c] * mean[c]; });
  coupling_->apply(u_, dg_, force_, energy_);
  parallel_for(n_cells_,
               [&](Index c) { by_mean_[c] = g_prime_[c] * energy_[c] + damage_.mean_curvature(c) * mean[c]; });
  const CellField<double> drive = by.spread(by_mean_);
  parallel_for(n_cells_, [&](Index c) {
    const double own = diagonal_[c] - damage_.mean_diagonal(c);
    const double fluxes = own * dd_[c] - damage_.coupling().times(c, dd_.data());
    of(y, c) = is_held(c) ? of(x, c) : (fluxes + drive[c]) / root_[c];
  });
}

void CoupledSystem::apply(const std::vector<Vector>& x, std::vector<Vector>& y) {
  std::copy_n(x.begin(), n_u_, u_.begin());
  y.back().setZero();  // the last vector may have room for more cells than there are
  if (coupling_) {
    add_damage(x, y);
  } else {
    momentum_.balance().apply(u_, force_);
    std::copy(x.begin() + n_u_, x.end(), y.begin() + n_u_);
  }
  std::copy(force_.begin(), force_.end(), y.begin());
}

void CoupledSystem::precondition(const std::vector<Vector>& r, std::vector<Vector>& z) {
  std::copy_n(r.begin(), n_u_, force_.begin());
  z.back().setZero();
  if (coupling_) {
    parallel_for(n_cells_, [&](Index c) {
      r_d_[c] = is_held(c) ? 0.0 : of(r, c) * root_[c];
      z_d_[c] = 0.0;
    });
    const ConjugateGradients::Tolerance tolerance{
        .reduction = damage_reduction, .least = 0.0, .most_iterations = most_damage_iterations};
    by_damage_.solve(diagonal_, held_, tolerance, r_d_, z_d_);
    parallel_for(n_cells_, [&](Index c) { dd_[c] = z_d_[c]; });
    const CellField<double> mean = damage_.stiffness_damage().means(dd_);
    parallel_for(n_cells_, [&](Index c) {
      dg_[c] = g_prime_[c] * mean[c];
      of(z, c) = is_held(c) ? of(r, c) : z_d_[c] * root_[c];
    });
    coupling_->apply(dg_, force_);
    parallel_for(count_of(force_), [&](Index i) { force_[i] = r[i] - force_[i]; });
  } else {
    std::copy(r.begin() + n_u_, r.end(), z.begin() + n_u_);
  }
  momentum_.precondition(force_, u_);
  std::copy(u_.begin(), u_.end(), z.begin());
}

KrylovResult CoupledSystem::solve(const std::vector<Vector>& b, double reduction, Index most_iterations,
                                  std::vector<Vector>& x) {
  const KrylovProblem problem{
      .apply = [&](const std::vector<Vector>& from, std::vector<Vector>& to) { apply(from, to); },
      .precondition = [&](const std::vector<Vector>& r, std::vector<Vector>& z) { precondition(r, z); },
      .scale = scale(),
      .restart_length = std::min<Index>(most_iterations, 60)};
  return solve_fgmres(
      problem, b, x, [&](double initial) { return reduction * initial; }, most_iterations);
}

}  // namespace pfdm
