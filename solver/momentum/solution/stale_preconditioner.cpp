#include "solver/momentum/solution/stale_preconditioner.h"

#include "solver/momentum/finite_strain/finite_tractions.h"
#include "solver/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pfdm {
namespace {

// Factor by which a stiffness may change before the preconditioner is rebuilt.
constexpr double bearable_ratio = 2.0;

double ratio(double a, double b) { return std::max(a / b, b / a); }

// Largest ratio of two stiffnesses in any direction.
double ratio(const Tensor& a, const Tensor& b) {
  const auto eigenvalues =
      Eigen::GeneralizedSelfAdjointEigenSolver<Tensor>(a, b, Eigen::EigenvaluesOnly | Eigen::Ax_lBx).eigenvalues();
  return std::max(eigenvalues[2], 1.0 / eigenvalues[0]);
}

}  // namespace

bool StalePreconditioner::renew(const CellField<double>& measure, const CellField<IsotropicElasticity>& moduli) {
  if (state_ != State::missing && !has_changed(measure) && !(struggled_ && has_moved(moduli))) return false;
  measure_ = measure;
  moduli_ = moduli;
  state_ = State::due;
  return true;
}

bool StalePreconditioner::renew(const CellField<double>& measure) {
  if (state_ != State::missing && !has_changed(measure)) return false;
  measure_ = measure;
  moduli_ = {};
  state_ = State::due;
  return true;
}

bool StalePreconditioner::renew(const CellField<double>& measure, const FiniteTractions& tractions) {
  if (state_ != State::missing && !struggled_ && !has_changed(measure) && !has_deformed(tractions)) return false;
  measure_ = measure;
  deformation_ = tractions.states().deformation();
  state_ = State::due;
  return true;
}

bool StalePreconditioner::renew_springs(std::vector<Tensor> in_series) {
  if (springs_.size() == in_series.size() &&
      parallel_max(count_of(in_series), [&](Index k) { return ratio(in_series[k], springs_[k]); }) <= bearable_ratio)
    return false;
  springs_ = std::move(in_series);
  if (state_ == State::serving) state_ = State::due;
  return true;
}

bool StalePreconditioner::has_changed(const CellField<double>& measure) const {
  return parallel_max(measure.size(), [&](Index c) { return ratio(measure[c], measure_[c]); }) > bearable_ratio;
}

bool StalePreconditioner::has_moved(const CellField<IsotropicElasticity>& moduli) const {
  if (moduli_.size() == 0) return true;
  return parallel_max(moduli.size(), [&](Index c) {
           return ratio(moduli[c].lambda + 2.0 * moduli[c].mu, moduli_[c].lambda + 2.0 * moduli_[c].mu);
         }) > bearable_ratio;
}

// Broken cells may do as they like: their stiffness counts.
bool StalePreconditioner::has_deformed(const FiniteTractions& tractions) const {
  constexpr double much = 0.5, soft = 0.05;
  const CellField<Tensor>& F = tractions.states().deformation();
  return parallel_max(F.size(), [&](Index c) {
           return tractions.states().is_softer(c, soft) ? 0.0 : (F[c] - deformation_[c]).norm();
         }) > much;
}

}  // namespace pfdm
