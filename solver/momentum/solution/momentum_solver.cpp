#include "solver/momentum/solution/momentum_solver.h"

#include "solver/momentum/solution/free_strain_modes.h"
#include "solver/momentum/solution/rigid_modes.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

// Relative change of g up to which the weights of the gradients are kept.
constexpr double bearable_lag = 0.01;

// Composites that fill a box have stiff inclusions, and may be held at points only; interfaces cut particles off.
const LinearSolver& solver_for(const Unknowns& unknowns, const LinearSolver* linear) {
  const LinearSolver& plain = linear != nullptr ? *linear : linear_solvers().front();
  return unknowns.motion.any() || !unknowns.split_faces.empty() ? with_rigid_modes(plain) : plain;
}

// Secants, as the compact matrix has them: these are never negative.
std::vector<FaceSpring> by_secants(std::vector<FaceSpring> springs) {
  for (FaceSpring& spring : springs) {
    spring.stiffness = spring.secant;
    spring.turn_P = spring.turn_N = Tensor::Zero();
  }
  return springs;
}

}  // namespace

MomentumSolver::MomentumSolver(const Mesh& mesh, const Unknowns& unknowns, const LinearSolver* linear)
    : unknowns_(unknowns),
      operator_(mesh, unknowns),
      is_slender_(operator_.is_slender()),
      preconditioner_(solver_for(unknowns, linear).make(mesh, unknowns)),
      strain_modes_(unknowns.has_free_strains() ? std::make_unique<FreeStrainModes>(mesh, unknowns, linear) : nullptr) {
}

MomentumSolver::~MomentumSolver() = default;
MomentumSolver::MomentumSolver(MomentumSolver&&) noexcept = default;

void MomentumSolver::set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g,
                                HistoryStress history) {
  const bool afresh = stale_.begin(!stale_.was_built_for(moduli));
  if (history.any()) reference_load_.reset();
  operator_.set_moduli(moduli, g, afresh ? 0.0 : bearable_lag, std::move(history));
  // With split faces it waits for their springs.
  if (stale_.renew(g, moduli) && unknowns_.split_faces.empty()) build_preconditioner();
}

void MomentumSolver::set_law(StrainLaw law, const CellField<double>& g, const std::vector<Vector>& u) {
  const bool afresh = stale_.begin(true);
  stale_.renew(operator_.set_law(std::move(law), g, u, afresh, afresh ? 0.0 : bearable_lag));
}

void MomentumSolver::set_finite(const FiniteLawAt& law, const std::vector<GapStress>& gaps, const CellField<double>& g,
                                const std::vector<Vector>& u, double t) {
  const double lag = stale_.begin(true) ? 0.0 : bearable_lag;
  const CellField<double> measure = operator_.set_finite(law, gaps, g, u, t, lag);
  stale_.renew(measure, *operator_.finite());
}

void MomentumSolver::set_springs(std::vector<FaceSpring> springs, const std::vector<double>& bond) {
  constexpr double least = 1e-3;  // of the bond: a softer face hardly connects
  const Tensor one = Tensor::Identity();
  std::vector<Tensor> in_series(springs.size());
  parallel_for(count_of(springs), [&](Index k) {
    const Tensor spring = springs[k].secant + least * bond[k] * one;
    in_series[k] = (spring.inverse() + one / bond[k]).inverse();
  });
  operator_.set_springs(std::move(springs));
  stale_.renew_springs(std::move(in_series));
}

void MomentumSolver::build_preconditioner() {
  const BlockTriplets compact = operator_.compact_matrix();
  scale_.resize(compact.diagonal.size());
  for (std::size_t i = 0; i < scale_.size(); ++i) scale_[i] = 1.0 / std::sqrt(compact.diagonal[i].trace() / 3.0);
  pressure_compliance_ = operator_.pressure_compliance();
  for (const double s : pressure_compliance_) scale_.push_back(1.0 / std::sqrt(s));
  for (const FreeStrain& free : unknowns_.motion.free_strains)
    scale_.push_back(1.0 / std::sqrt(unknowns_.motion.size.prod() * free.modulus));
  std::vector<FaceSpring> springs = operator_.springs();
  operator_.set_springs(by_secants(springs));
  preconditioner_->build(compact, operator_);
  if (strain_modes_) strain_modes_->build(operator_);
  operator_.set_springs(std::move(springs));
  stale_.was_built();
  reference_load_.reset();
  ++n_preconditioners_;
}

void MomentumSolver::precondition(const std::vector<Vector>& r, std::vector<Vector>& z) {
  const Index n = unknowns_.n_nodes();
  const bool has_pressures = !pressure_compliance_.empty();
  if (has_pressures) {
    parallel_for(count_of(pressure_compliance_), [&](Index k) { z[n + k] = r[n + k] / pressure_compliance_[k]; });
    rest_ = r;
    operator_.take_away_pressure_forces(z, rest_);
  }
  preconditioner_->apply(has_pressures ? rest_ : r, z);
  parallel_for(n, [&](Index i) {
    // Prescribed components stay unchanged.
    if (i >= unknowns_.n_cells) z[i] = unknowns_.free_directions[i - unknowns_.n_cells] * z[i];
  });
  std::fill(z.begin() + unknowns_.first_strain(), z.end(), Vector::Zero());
  operator_.move_images(z);
  if (strain_modes_) strain_modes_->correct(r, z);
  operator_.keep_in_plane(z);
}

// The norm that residuals are measured against: that of the prescribed values, of the eigenstrains and of what a
// viscoelastic body has not relaxed. (Forces
// over the root of their stiffness are roots of energies.)
double MomentumSolver::reference_norm(double t, const std::vector<Vector>& load) {
  if (reference_load_ == t) return reference_;
  std::vector<Vector> prescribed(load.size(), Vector::Zero()), image(load.size());
  operator_.prescribe(t, prescribed);
  operator_.apply(prescribed, image);
  std::vector<Vector> given = load;
  if (operator_.finite() != nullptr) {  // the linearised law's constant part belongs to the displacements of now
    given = operator_.traction_forces(t);
    add_body_force(given);
  }
  for (std::size_t i = 0; i < load.size(); ++i) image[i] = given[i] - image[i];
  reference_load_ = t;
  reference_ = scaled_norm(image, scale_);
  if (unknowns_.loads.eigenstrain) reference_ = std::hypot(reference_, std::sqrt(operator_.energy_if_held()));
  if (const double remembered = operator_.energy_remembered(); remembered > 0.0)
    reference_ = std::hypot(reference_, std::sqrt(remembered));
  if (!held_forces_.empty()) {
    std::vector<Vector> held(load.size(), Vector::Zero());
    operator_.pull_split_faces(held_forces_, held);
    reference_ = std::hypot(reference_, scaled_norm(held, scale_));
  }
  return reference_;
}

double MomentumSolver::residual(double t, const std::vector<Vector>& u) {
  // Residuals are compared between linearisations.
  const bool keeps_scale = operator_.is_linearised() && !scale_.empty();
  if (is_due() && !keeps_scale) build_preconditioner();
  std::vector<Vector> rest = load_vector(t), image(u.size());
  const double reference = reference_norm(t, rest);
  if (reference == 0.0) return 0.0;
  operator_.add_spring_offsets(rest);
  operator_.apply(u, image);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= image[i];
  return scaled_norm(rest, scale_) / reference;
}

void MomentumSolver::set_body_force(std::vector<Vector> force) {
  assert(force.empty() || force.size() == as_size(unknowns_.n_cells) || force.size() == as_size(unknowns_.n_nodes()));
  body_force_ = std::move(force);
  reference_load_.reset();
}

void MomentumSolver::set_held_forces(std::vector<Vector> forces) {
  if (forces.empty() && held_forces_.empty()) return;
  held_forces_ = std::move(forces);
  reference_load_.reset();
}

std::vector<Vector> MomentumSolver::load_vector(double t) const {
  std::vector<Vector> load = operator_.load_vector(t);
  add_body_force(load);
  return load;
}

void MomentumSolver::add_body_force(std::vector<Vector>& load) const {
  for (std::size_t c = 0; c < body_force_.size(); ++c) load[c] += body_force_[c];
}

std::vector<Vector> MomentumSolver::unbalanced_forces(double t, const std::vector<Vector>& u) const {
  std::vector<Vector> rest = load_vector(t), image(u.size());
  operator_.add_spring_offsets(rest);
  operator_.apply(u, image);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= image[i];
  return rest;
}

Equilibrium MomentumSolver::solve(double t, const Tolerance& tolerance, std::vector<Vector>& u) {
  if (is_due()) build_preconditioner();
  std::vector<Vector> load = load_vector(t);
  const double reference = reference_norm(t, load);
  operator_.add_spring_offsets(load);
  operator_.prescribe(t, u);
  if (reference == 0.0) {
    // Interfaces that have slid bear no friction without pressure: without load and branches theirs is zero too.
    std::fill(u.begin(), u.end(), Vector::Zero());
    return {.converged = true};
  }
  const KrylovProblem problem{
      .apply = [this](const std::vector<Vector>& x, std::vector<Vector>& y) { operator_.apply(x, y); },
      .precondition = [this](const std::vector<Vector>& r, std::vector<Vector>& z) { precondition(r, z); },
      .constrain = [&](std::vector<Vector>& x) { operator_.prescribe(t, x); },
      .scale = scale_,
      .restart_length = restart_length(),
      .stores_doubles = has_long_cycles(),
      .good_enough = tolerance.good_enough * reference};
  const auto target = [&](double initial) {
    return std::max(tolerance.floor * reference,
                    std::min(tolerance.ceiling * reference, tolerance.reduction * initial));
  };
  const Index most =
      std::max(tolerance.most_iterations, is_slender_ && tolerance.whole_cycle ? problem.restart_length : 0);
  const KrylovResult result = solve_fgmres(problem, load, u, target, most);
  stale_.was_used(result.converged);
  return {.converged = result.converged,
          .iterations = result.iterations,
          .initial_residual = result.initial_residual / reference,
          .residual = result.residual / reference};
}

// Long beams have many slow modes, on which short cycles stagnate (33 x 4 cells under a distributed load: 2,000
// iterations with cycles of 40, 82 with 200, in double precision).
Index MomentumSolver::restart_length() const {
  const Index usual = pressure_compliance_.empty() ? 40 : 80;
  if (!has_long_cycles()) return usual;
  constexpr Index longest = 200, most_stored = 1500000;  // pairs of vectors of 24 bytes: 72 MB
  return std::clamp(most_stored / n_nodes(), usual, longest);
}

bool MomentumSolver::has_long_cycles() const { return is_slender_ || operator_.is_of_third_order(); }

}  // namespace pfdm
