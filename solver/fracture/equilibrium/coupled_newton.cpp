#include "solver/fracture/equilibrium/coupled_newton.h"

#include "solver/momentum/stiffness_coupling.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// A larger change of damage by one iteration of the alternation is a jump under way.
constexpr double jump = 0.03;
// Change over the change before: while it falls below, the alternation converges by itself.
constexpr double quick = 0.2;
// Reductions of the residual of the linear system.
constexpr double reduction = 0.05, damage_reduction = 0.1;
constexpr Index most_iterations = 60, most_damage_iterations = 50;
// Rise of the energy, relative, that equilibria which are solved to 1e-4 leave uncertain.
constexpr double bearable_rise = 1e-6;
constexpr double shrinkage = 0.25, growth = 2.0, least_radius = 0.05, most_radius = 1.0;
// Least length of a step over the change by an iteration of the alternation: a shorter one is not worth while.
constexpr double least_gain = 2.0;
constexpr int most_trials = 3, most_wait = 16;

double largest_change(const CellField<double>& from, const CellField<double>& to) {
  return parallel_max(from.size(), [&](Index c) { return std::abs(to[c] - from[c]); });
}

}  // namespace

// The linear system. Its vectors are the displacements, then the damages, three to a vector and times the square root
// of their diagonal, so that both parts of the residual are of the energy norm's size.
struct CoupledNewton::System {
  MomentumSolver& momentum;
  const DamageEquation& damage;
  StiffnessCoupling coupling;
  Index n_cells;
  std::size_t n_u;
  CellField<double> g_prime, root;  // root of the diagonal
  std::vector<double> diagonal, r_d, z_d;
  ConjugateGradients::Held held;
  ConjugateGradients by_damage;
  CellField<double> dd, dg, energy, by_mean;
  std::vector<Vector> u, force;

  System(const CoupledNewton& newton, const Iterate& at, const FractureState& state, const CellField<double>& answer)
      : momentum(newton.momentum_),
        damage(newton.damage_),
        coupling(momentum.balance(), newton.part_, state.displacement),
        n_cells(newton.mesh_.n_cells()),
        n_u(state.displacement.size()),
        g_prime(damage.stiffness_slopes(state.damage)),
        root(n_cells, 1.0),
        diagonal(n_cells, 1.0),
        r_d(n_cells),
        z_d(n_cells),
        held(n_cells, 1),
        by_damage(damage.coupling()),
        dd(n_cells),
        dg(n_cells),
        energy(n_cells),
        by_mean(n_cells),
        u(n_u),
        force(n_u) {
    parallel_for(n_cells, [&](Index c) {
      if (!damage.is_damageable(c)) return;
      diagonal[c] = damage.diagonal(c, state.damage[c], state.driving_energy[c]);
      root[c] = std::sqrt(diagonal[c]);
      held[c] = answer[c] > at.lower[c] && answer[c] < 1.0 ? 0 : 1;
    });
  }

  std::size_t size() const { return n_u + as_size((n_cells + 2) / 3); }
  double& of(std::vector<Vector>& x, Index c) const { return x[n_u + as_size(c / 3)][c % 3]; }
  double of(const std::vector<Vector>& x, Index c) const { return x[n_u + as_size(c / 3)][c % 3]; }
  bool is_held(Index c) const { return held[c] != 0; }

  void apply(const std::vector<Vector>& x, std::vector<Vector>& y) {
    std::copy_n(x.begin(), n_u, u.begin());
    parallel_for(n_cells, [&](Index c) { dd[c] = of(x, c) / root[c]; });
    const StiffnessDamage& by = damage.stiffness_damage();
    const CellField<double> mean = by.means(dd);
    parallel_for(n_cells, [&](Index c) { dg[c] = g_prime[c] * mean[c]; });
    coupling.apply(u, dg, force, energy);
    parallel_for(n_cells, [&](Index c) { by_mean[c] = g_prime[c] * energy[c] + damage.mean_curvature(c) * mean[c]; });
    const CellField<double> drive = by.spread(by_mean);
    std::copy(force.begin(), force.end(), y.begin());
    y.back().setZero();  // the last vector may have room for more cells than there are
    parallel_for(n_cells, [&](Index c) {
      const double own = diagonal[c] - damage.mean_diagonal(c);
      const double fluxes = own * dd[c] - damage.coupling().times(c, dd.data());
      of(y, c) = is_held(c) ? of(x, c) : (fluxes + drive[c]) / root[c];
    });
  }

  void precondition(const std::vector<Vector>& r, std::vector<Vector>& z) {
    parallel_for(n_cells, [&](Index c) {
      r_d[c] = is_held(c) ? 0.0 : of(r, c) * root[c];
      z_d[c] = 0.0;
    });
    const ConjugateGradients::Tolerance tolerance{
        .reduction = damage_reduction, .least = 0.0, .most_iterations = most_damage_iterations};
    by_damage.solve(diagonal, held, tolerance, r_d, z_d);
    z.back().setZero();
    parallel_for(n_cells, [&](Index c) { dd[c] = z_d[c]; });
    const CellField<double> mean = damage.stiffness_damage().means(dd);
    parallel_for(n_cells, [&](Index c) {
      dg[c] = g_prime[c] * mean[c];
      of(z, c) = is_held(c) ? of(r, c) : z_d[c] * root[c];
    });
    coupling.apply(dg, force);
    parallel_for(count_of(force), [&](Index i) { force[i] = r[i] - force[i]; });
    momentum.precondition(force, u);
    std::copy(u.begin(), u.end(), z.begin());
  }
};

bool CoupledNewton::suits(const Mesh& mesh, const Unknowns& unknowns) {
  return prefers_direct(mesh) && StiffnessCoupling::covers(mesh, unknowns);
}

CoupledNewton::Direction CoupledNewton::solve(const Iterate& at, const FractureState& state,
                                              const CellField<double>& answer) {
  System system(*this, at, state, answer);
  // The first guess is the step of the alternation; cells that the answer puts on a bound go there.
  std::vector<Vector> b = momentum_.unbalanced_forces(state.load, state.displacement), x(system.size(), Vector::Zero());
  b.resize(system.size(), Vector::Zero());
  for (Index c = 0; c < system.n_cells; ++c) {
    system.of(x, c) = (answer[c] - state.damage[c]) * system.root[c];
    system.of(b, c) = system.is_held(c) ? system.of(x, c)
                                        : -damage_.imbalance(c, state.damage, state.driving_energy[c]) / system.root[c];
  }
  std::vector<double> scale = momentum_.row_scale();
  scale.resize(system.size(), 1.0);
  const KrylovProblem problem{
      .apply = [&](const std::vector<Vector>& from, std::vector<Vector>& to) { system.apply(from, to); },
      .precondition = [&](const std::vector<Vector>& r, std::vector<Vector>& z) { system.precondition(r, z); },
      .scale = std::move(scale),
      .restart_length = most_iterations};
  const auto target = [](double initial) { return reduction * initial; };
  krylov_iterations_ = solve_fgmres(problem, b, x, target, most_iterations).iterations;
  Direction direction{.u = {x.begin(), x.begin() + static_cast<std::ptrdiff_t>(system.n_u)},
                      .d = CellField<double>(system.n_cells)};
  for (Index c = 0; c < system.n_cells; ++c) direction.d[c] = system.of(x, c) / system.root[c];
  direction.slope = -parallel_sum(count_of(x), [&](Index i) { return b[i].dot(x[i]); });
  direction.largest = parallel_max(system.n_cells, [&](Index c) { return std::abs(direction.d[c]); });
  return direction;
}

// Negative shares lead the other way.
void CoupledNewton::go(double share, const CellField<double>& lower, FractureState& state) {
  base_->share = share;
  ++base_->tries;
  const Direction& direction = base_->direction;
  parallel_for(count_of(base_->u), [&](Index i) { state.displacement[i] = base_->u[i] + share * direction.u[i]; });
  parallel_for(base_->d.size(),
               [&](Index c) { state.damage[c] = std::clamp(base_->d[c] + share * direction.d[c], lower[c], 1.0); });
}

CoupledNewton::Moved CoupledNewton::retreat(const Iterate& at, FractureState& state, CellField<double>& answer) {
  const double share = shrinkage * base_->share;
  radius_ = std::abs(share) * base_->direction.largest;
  if (radius_ > least_gain * base_->change && base_->tries < most_trials) {
    go(share, at.lower, state);
    return Moved::on;
  }
  radius_ = std::max(radius_, least_radius);
  wait_ = next_wait_ = std::min(2 * next_wait_, most_wait);
  state.displacement = std::move(base_->u);
  state.damage = std::move(base_->d);
  answer = std::move(base_->answer);
  base_.reset();
  return Moved::back;
}

CoupledNewton::Moved CoupledNewton::move(const Iterate& at, FractureState& state, CellField<double>& answer) {
  krylov_iterations_ = 0;
  if (base_ && !(at.energy <= base_->energy + bearable_rise * std::abs(base_->energy)))
    return retreat(at, state, answer);
  if (base_) {
    next_wait_ = std::max(1, next_wait_ / 2);
    if (base_->tries == 1 && std::abs(base_->share) < 1.0) radius_ = std::min(growth * radius_, most_radius);
    base_.reset();
  }
  const double change = largest_change(state.damage, answer);
  begun_ = begun_ || change > quick * change_before_;
  change_before_ = change;
  if (!begun_ || wait_ > 0 || change > jump) {
    wait_ = std::max(0, wait_ - 1);
    return Moved::no;
  }
  Direction direction = solve(at, state, answer);
  if (!std::isfinite(direction.largest) || direction.largest == 0.0) return Moved::no;
  const double way = direction.slope > 0.0 ? -1.0 : 1.0, share = std::min(1.0, radius_ / direction.largest);
  base_ = Base{.u = state.displacement,
               .d = state.damage,
               .answer = answer,
               .direction = std::move(direction),
               .energy = at.energy,
               .change = change};
  go(way * share, at.lower, state);
  return Moved::on;
}

}  // namespace pfdm
