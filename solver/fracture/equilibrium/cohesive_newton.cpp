#include "solver/fracture/equilibrium/cohesive_newton.h"

#include "solver/fracture/equilibrium/finite_newton.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr Index most_solves = 1000, most_finite_solves = 600;
constexpr double falls = 0.7;                 // of the residual by a step of Newton's that leads on
constexpr double linear_reduction = 0.02;     // of the residual of the linearised equation
constexpr double convex_reduction = 0.1;      // likewise, without what softens
constexpr Index most_newton_iterations = 80;  // of FGMRES: where the tangent is not definite more do not help
constexpr double lost = 1e6;                  // residual from which nothing leads back, over that at the start
constexpr double bearable_rest = 0.3;         // of the residual, after so many
constexpr double bearable_circles = 1e-3;  // residual with which damage may go on where the iteration goes in circles
constexpr double exact_enough = 1e-4;  // residual at finite strain below which settling, of second order, adds to it

/// Whether the next step is by tangent or by its convex part. Convex steps lead from below to where the faces come to
/// rest, however far that is; where tangents do not lead on, the iteration goes back to where those had come to.
class WayOut {
 public:
  explicit WayOut(const std::vector<Vector>& u) : kept_(u) {}

  bool is_marching() const { return marching_; }

  /// After a step from `residual` whose linear equation was solved or not.
  CohesiveFaces::Way next(double residual, bool solved, std::vector<Vector>& u) {
    using enum CohesiveFaces::Way;
    return (marching_ ? comes_to_rest(residual, u) : leads_on(residual, solved, u)) ? tangent : convex;
  }

 private:
  bool leads_on(double residual, bool solved, std::vector<Vector>& u) {
    misses_ = residual < falls * least_ && solved ? 0 : misses_ + 1;
    least_ = std::min(least_, residual);
    if (misses_ <= (has_marched_ ? misses_after_march : bearable_misses) && solved) return true;
    u = kept_;
    marching_ = has_marched_ = true;
    steps_ = falling_ = 0;
    last_ = infinity;
    return false;
  }

  // The residual grows while faces break one after the other, and falls when the rest of them holds.
  bool comes_to_rest(double residual, std::vector<Vector>& u) {
    falling_ = residual < last_ ? falling_ + 1 : 0;
    last_ = residual;
    ++steps_;
    if (falling_ < falling_in_a_row_ && steps_ < most_steps) return false;
    falling_in_a_row_ = std::min<Index>(2 * falling_in_a_row_, most_steps);
    kept_ = u;
    marching_ = false;
    misses_ = 0;
    least_ = infinity;
    return true;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr Index bearable_misses = 3;  // faces that pass their strength raise the residual
  static constexpr Index misses_after_march = 2, most_steps = 32;
  std::vector<Vector> kept_;
  double least_ = infinity, last_ = infinity;  // residual since the last march, and in it
  Index misses_ = 0, steps_ = 0, falling_ = 0, falling_in_a_row_ = 4;
  bool marching_ = false, has_marched_ = false;
};

/// Tells iterations that go in circles: their residuals come back.
class Circles {
 public:
  /// Whether residuals have come back too often, this one among them.
  bool close_with(double residual) {
    const auto is_it = [&](double other) { return std::abs(other - residual) <= alike * residual; };
    if (std::ranges::any_of(seen_, is_it)) ++returns_;
    seen_.push_back(residual);
    return returns_ >= bearable_returns;
  }

 private:
  static constexpr double alike = 1e-5;
  static constexpr Index bearable_returns = 20;
  std::vector<double> seen_;
  Index returns_ = 0;
};

/// Newton's iteration for the equilibrium with the laws of the faces at the load t; u is moved.
class FacesNewton {
 public:
  FacesNewton(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before, double t,
              const MomentumSolver::Tolerance& tolerance, const CellLaws& cells, MomentumSolver& momentum,
              std::vector<Vector>& u, std::vector<InterfaceHistory>& after)
      : faces_(faces),
        before_(before),
        t_(t),
        tolerance_(tolerance),
        cells_(cells),
        momentum_(momentum),
        u_(u),
        after_(after),
        way_out_(u),
        has_rate_(faces.has_rate_laws()),
        is_sound_(faces.are_sound(before)) {}

  Equilibrium solve(const BalanceWatch& watch) {
    momentum_.set_held_forces(faces_.held_forces(before_));
    const Index most = cells_ ? most_finite_solves : most_solves;
    double last = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < most; ++k) {
      const Equilibrium step = take_step(k, watch);
      const double residual = step.initial_residual;  // at the u that the step began with
      note(step, k == 0);
      if (whole_.converged && has_rate_) return without_last_step();  // the overstresses belong to it
      if (whole_.converged || !std::isfinite(step.residual)) return whole_;
      const bool solved = step.residual < bearable_rest * residual;
      if (residual <= tolerance_.good_enough && !(solved && residual < falls * last)) return without_last_step();
      if (residual > lost * std::max(1.0, whole_.initial_residual)) return without_hope();
      if (circles_.close_with(residual)) {
        if (residual > bearable_circles) return without_hope();
        break;
      }
      // After the first solve of sound faces, too: what is left of it takes stiff ones far beyond their strength.
      const bool is_rough = k == 0 && is_sound_ && (!cells_ || residual > exact_enough);
      if (!has_rate_ && (is_rough || way_out_.is_marching() || residual > falls * last)) settle();
      last = residual;
      way_ = way_out_.next(residual, solved, u_);
      if (cells_) cells_();
    }
    if (has_rate_) settle();
    if (cells_) whole_.residual = std::numeric_limits<double>::infinity();
    return whole_;
  }

 private:
  void settle() { faces_.settle(before_, momentum_.balance(), u_, after_); }

  // One linear solve. The residual at its start is that of the true laws; at finite strain to the second order in what
  // `settle` moves.
  Equilibrium take_step(Index k, const BalanceWatch& watch) {
    const bool newton = way_ == CohesiveFaces::Way::tangent;
    if (has_rate_) {
      momentum_.balance().prescribe(t_, u_);
      settle();
    }
    if (has_rate_ || cells_ || tolerance_.good_enough > 0.0) from_ = u_;
    faces_.linearise(u_, before_, after_, way_, momentum_);
    if (watch && k > 0) watch(k, whole_.residual);
    const Equilibrium step =
        momentum_.solve(t_,
                        {.reduction = newton ? linear_reduction : convex_reduction,
                         .ceiling = 1.0,
                         .floor = 0.5 * target_,
                         .most_iterations = newton ? most_newton_iterations : tolerance_.most_iterations,
                         .whole_cycle = !newton},
                        u_);
    if (cells_) shorten();
    return step;
  }

  // Halves a step while it turns a sound cell inside out.
  void shorten() {
    constexpr int most_halvings = 8;
    cells_();
    for (int k = 0; k < most_halvings && inverts(momentum_.balance()); ++k) {
      parallel_for(count_of(u_), [&](Index i) { u_[i] = 0.5 * (from_[i] + u_[i]); });
      cells_();
    }
  }

  void note(const Equilibrium& step, bool is_first) {
    whole_.iterations += step.iterations;
    whole_.residual = step.initial_residual;
    if (is_first) {
      whole_.initial_residual = step.initial_residual;
      target_ = tolerance_.target(step.initial_residual);
    }
    whole_.converged = step.initial_residual <= target_;
  }

  Equilibrium without_hope() {
    whole_.residual = std::numeric_limits<double>::infinity();
    return whole_;
  }

  Equilibrium without_last_step() {
    u_ = std::move(from_);
    if (cells_) cells_();
    return whole_;
  }

  const CohesiveFaces& faces_;
  const std::vector<InterfaceHistory>& before_;
  double t_;
  const MomentumSolver::Tolerance& tolerance_;
  const CellLaws& cells_;
  MomentumSolver& momentum_;
  std::vector<Vector>& u_;
  std::vector<InterfaceHistory>& after_;
  WayOut way_out_;
  Circles circles_;
  bool has_rate_;             // steep where faces begin to move
  bool is_sound_;             // before the step
  std::vector<Vector> from_;  // before the step
  CohesiveFaces::Way way_ = CohesiveFaces::Way::tangent;
  double target_ = 0.0;  // of the residual
  Equilibrium whole_{.converged = false, .iterations = 0, .initial_residual = 0.0, .residual = 0.0};
};

}  // namespace

Equilibrium solve_with_faces(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before, double t,
                             const MomentumSolver::Tolerance& tolerance, const CellLaws& cells,
                             MomentumSolver& momentum, std::vector<Vector>& u, std::vector<InterfaceHistory>& after,
                             const BalanceWatch& watch) {
  return FacesNewton(faces, before, t, tolerance, cells, momentum, u, after).solve(watch);
}

}  // namespace pfdm
