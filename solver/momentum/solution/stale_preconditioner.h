#pragma once
// Decides whether a preconditioner that was built for an earlier stiffness still serves. It is rebuilt when some cell
// or split face has changed its stiffness by more than a factor of 2.

#include "mesh/fields.h"
#include "physics/elasticity/elasticity.h"
#include "physics/tensor.h"

#include <utility>
#include <vector>

namespace pfdm {

class FiniteTractions;

class StalePreconditioner {
 public:
  enum class State {
    missing,  ///< there is none, or its stiffness is not to be seen in the results
    due,      ///< the next solution has to build it
    serving,  ///< it was built for a stiffness close to that of now
  };

  State state() const { return state_; }
  /// The next stiffness begins anew, so that results do not depend on earlier states.
  void start_afresh() {
    is_afresh_ = true;
    struggled_ = false;
    springs_.clear();
  }
  /// Begins another stiffness; `differs` if it is not the one that was built for. Returns whether all that depends on
  /// earlier states has to be found anew.
  bool begin(bool differs) {
    if (is_afresh_ && differs) state_ = State::missing;
    return std::exchange(is_afresh_, false) || state_ == State::missing;
  }
  bool was_built_for(const CellField<IsotropicElasticity>& moduli) const { return moduli == moduli_; }

  /// Compares the stiffness of now with the one that was built for; true if the next solution has to build it. The
  /// `measure` is of the stiffness of each cell, any, but always the same. Of isotropic cells: if the last solution did
  /// not converge, their moduli count too (cracks that have closed or opened change them at the same g).
  bool renew(const CellField<double>& measure, const CellField<IsotropicElasticity>& moduli);
  /// Compares the stiffness of cells of general stiffness.
  bool renew(const CellField<double>& measure);
  /// Compares the stiffness at finite strain: due also if cells that are not broken have turned or stretched by a good
  /// part.
  bool renew(const CellField<double>& measure, const FiniteTractions& tractions);
  /// Compares the stiffness of the split faces, in series with that of the cells beside them, in every direction:
  /// symmetric and positive definite.
  bool renew_springs(std::vector<Tensor> in_series);

  void was_built() { state_ = State::serving; }
  void was_used(bool converged) { struggled_ = !converged; }

 private:
  bool has_changed(const CellField<double>& measure) const;
  bool has_moved(const CellField<IsotropicElasticity>& moduli) const;
  bool has_deformed(const FiniteTractions& tractions) const;

  State state_ = State::missing;
  bool is_afresh_ = false;
  bool struggled_ = false;  // the last solution did not converge
  // What it was built for:
  CellField<double> measure_;
  CellField<IsotropicElasticity> moduli_;  // empty for a general stiffness
  CellField<Tensor> deformation_;          // F; empty at small strain
  std::vector<Tensor> springs_;            // of the split faces in series with the cells beside them
};

}  // namespace pfdm
