#pragma once
// Elasticities of a curve and of its events out of derivatives of the states of one run.

#include "cases/program/studies/sensitivity/curve_sensitivity.h"

#include <string>
#include <vector>

namespace pfdm {

/// Derivatives at a row of the curve, by ln p or ln t at fixed load t.
struct RowDerivative {
  double force = 0.0;         ///< [N]
  double displacement = 0.0;  ///< [m]
  /// Of the jump that follows: d ln t/d ln p, and its error.
  struct Jump {
    double load = 0.0, error = 0.0;
  };
  Jump jump{};
  double unsolved = 0.0;       ///< share that the linear equations left
  bool is_after_jump = false;  ///< or after a row that is lost: the error is not known
};

struct DirectSensitivity {
  SampledCurve curve;
  std::vector<RowDerivative> by_load;               ///< at each row
  std::vector<std::vector<RowDerivative>> by;       ///< of each parameter
  std::vector<std::string> failures;                ///< of each parameter; empty: there is none
  bool is_turned = false;                           ///< displacements and forces have the other sign in the run
  bool may_debond = false;                          ///< it has cohesive interfaces
  double seconds_of_run = 0.0, seconds_more = 0.0;  ///< of the processor
};

/// Where the linear equations of a parameter leave an error as large as its derivative, as where cells of a crack break
/// one by one, what is frozen is lost: marks that row, and all later ones, as after a jump.
void mark_lost_rows(DirectSensitivity& direct);

/// At each row, at fixed displacement. Unknown where the force is below a hundredth of its largest.
std::vector<Elasticity> elasticities(const DirectSensitivity& direct, std::size_t parameter);

/// Of each quantity of an event: a greatest force from the rows about it, a jump from the last state before it.
std::vector<Elasticity> elasticities(const DirectSensitivity& direct, std::size_t parameter, const BaseEvent& event);

}  // namespace pfdm
