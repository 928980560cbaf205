#pragma once
// Newton's method for a scalar field u between bounds, with a non-linear local term f and the fluxes of a medium:
//
//   f_c(u_c) + (flux out of cell c) = 0,  lower_c <= u_c <= upper_c.
//
// Bounds by a primal-dual active set (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13 (2002) 865), linear systems by
// conjugate gradients.

#include "solver/linear/conjugate_gradients.h"
#include "solver/parallel.h"
#include "solver/scalar/two_point_flux.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <vector>

namespace pfdm {

struct ScalarSolution {
  Index active_set_iterations = 0;
  Index krylov_iterations = 0;
  bool converged = true;
};

struct ScalarTolerance {
  Index corrections = 1;    ///< number of updates of the deferred flux; an outer loop updates it at each iteration
  double reduction = 1e-9;  ///< of the initial value of the largest step of a cell by itself
  double least_step = 1e-10;
  bool damps = false;  ///< steps that go to and fro, where the slope of f varies much
};

/// What stands in a cell besides the fluxes.
template <class Local>
concept LocalTerm = requires(const Local& local, Index cell, double u) {
  { local.is_free(cell) } -> std::same_as<bool>;         ///< else u stays as it is
  { local.slope(cell, u) } -> std::same_as<double>;      ///< f, integrated over the cell
  { local.curvature(cell, u) } -> std::same_as<double>;  ///< df/du
  { local.lower(cell) } -> std::same_as<double>;
  { local.upper(cell) } -> std::same_as<double>;
};

template <LocalTerm Local>
class BoundedNewton {
 public:
  BoundedNewton(TwoPointFlux& flux, const Local& local, CellField<double>& u)
      : flux_(flux),
        local_(local),
        u_(u),
        n_(u.size()),
        linear_(flux.coupling()),
        held_(n_, 0),
        diagonal_(n_),
        damped_(n_),
        residual_(n_),
        step_(n_) {}

  /// Changes u.
  ScalarSolution solve(const ScalarTolerance& tolerance) {
    for (Index correction = 0; correction < tolerance.corrections; ++correction) {
      flux_.renew_correction(u_);
      iterate(tolerance);
      parallel_for(n_, [&](Index c) {
        if (local_.is_free(c)) u_[c] = std::clamp(u_[c], local_.lower(c), local_.upper(c));
      });
    }
    return account_;
  }

 private:
  void iterate(const ScalarTolerance& tolerance) {
    constexpr Index most_changes = 50;  // of the active set
    constexpr Index patience = 8;       // before steps are damped
    account_.converged = false;
    double target = 0.0;  // of the step that each cell would still take
    parallel_for(n_, [&](Index c) { held_[c] = local_.is_free(c) ? 0 : 1; });
    for (Index change = 0; change < most_changes; ++change) {
      parallel_for(n_, [&](Index c) {
        diagonal_[c] = damped_[c] = diagonal(c);
        residual_[c] = local_.is_free(c) ? -balance(c) : 0.0;
      });
      if (tolerance.damps && change >= patience) damp();
      choose_active();
      parallel_for(n_, [&](Index c) {
        residual_[c] = held_[c] != 0 ? 0.0 : -balance(c);
        step_[c] = 0.0;
      });
      const double wanted = parallel_max(n_, [&](Index c) { return std::abs(residual_[c]) / diagonal_[c]; });
      if (change == 0) target = std::max(tolerance.reduction * wanted, tolerance.least_step);
      account_.converged = wanted <= target;
      if (account_.converged) return;
      account_.krylov_iterations +=
          linear_.solve(damped_, held_, {.least = 0.1 * tolerance.least_step}, residual_, step_);
      parallel_for(n_, [&](Index c) { u_[c] += step_[c]; });
      ++account_.active_set_iterations;
    }
  }

  double balance(Index c) const { return flux_.balance(c, u_, local_.slope(c, u_[c])); }

  // Where f falls, cells in which it outweighs the fluxes would have a negative diagonal. One without fluxes goes to
  // the bound that its residual points to.
  double diagonal(Index c) const {
    constexpr double least = 0.1;  // of the fluxes' part
    const double fluxes = flux_.diagonal(c);
    const double sum = fluxes + local_.curvature(c, u_[c]);
    return std::max(sum, fluxes > 0.0 ? least * fluxes : std::numeric_limits<double>::min());
  }

  // Newton's steps can go to and fro between two sides of the solution for ever. A cell whose residual changes sign
  // takes the larger diagonal of both sides, half of it in the next iteration, and so on.
  void damp() {
    before_.resize(n_);
    parallel_for(n_, [&](Index i) {
      Before& before = before_[i];
      const bool overshot = residual_[i] * before.residual < 0.0;
      before.damped = overshot ? std::max({before.damped, before.diagonal, diagonal_[i]}) : 0.5 * before.damped;
      before.residual = residual_[i];
      before.diagonal = diagonal_[i];
      damped_[i] = std::max(diagonal_[i], before.damped);
    });
  }

  // Cells that a Newton step of their own would carry beyond a bound are put on it.
  void choose_active() {
    parallel_for(n_, [&](Index c) {
      if (!local_.is_free(c)) return;
      const double wanted = u_[c] + residual_[c] / damped_[c];
      held_[c] = wanted < local_.lower(c) ? -1 : (wanted > local_.upper(c) ? 1 : 0);
    });
    parallel_for(n_, [&](Index c) {
      if (local_.is_free(c) && held_[c] != 0) u_[c] = held_[c] < 0 ? local_.lower(c) : local_.upper(c);
    });
  }

  TwoPointFlux& flux_;
  const Local& local_;
  CellField<double>& u_;
  Index n_;
  ConjugateGradients linear_;
  ConjugateGradients::Held held_;  // -1 at the lower bound, 1 at the upper or held, 0 free
  std::vector<double> diagonal_, damped_, residual_, step_;
  struct Before {
    double residual = 0.0, diagonal = 0.0, damped = 0.0;
  };
  std::vector<Before> before_;  // of the last iteration; empty as long as no step is damped
  ScalarSolution account_;
};

}  // namespace pfdm
