#pragma once
// Flexible GMRES (Saad, SIAM J. Sci. Comput. 14 (1993) 461) with restarts. The basis is stored in single precision
// unless told otherwise; iterate, operator and the residual at every restart are in double precision, so the reported
// residual is the true one.

#include "physics/tensor.h"

#include <functional>
#include <vector>

namespace pfdm {

struct KrylovResult {
  bool converged = false;
  Index iterations = 0;
  double initial_residual = 0.0;  ///< scaled norm at the start
  double residual = 0.0;  ///< at the end: true, or that of the recurrence if the reduction within a cycle is modest
};

struct KrylovProblem {
  /// y = A x.
  std::function<void(const std::vector<Vector>& x, std::vector<Vector>& y)> apply;
  /// z approximates A^-1 r.
  std::function<void(const std::vector<Vector>& r, std::vector<Vector>& z)> precondition;
  /// Restores the constraints that x must satisfy exactly and the single-precision basis does not; may be empty.
  std::function<void(std::vector<Vector>& x)> constrain = {};
  /// The norm is that of scale_i r_i.
  std::vector<double> scale;
  Index restart_length = 40;  ///< vectors of a cycle
  /// The basis in double precision: cycles then follow modes far below the others, as those of slender beams.
  bool stores_doubles = false;
  double good_enough = 0.0;  ///< a residual from which on a cycle that does not halve it ends the solution
};

/// Improves x until the scaled residual of A x = b is at most target(initial residual), in at most `most_iterations`.
/// A reduction of less than four orders within a cycle is taken from the recurrence, which is reliable in single
/// precision; beyond that the residual is computed again.
KrylovResult solve_fgmres(const KrylovProblem& problem, const std::vector<Vector>& b, std::vector<Vector>& x,
                          const std::function<double(double initial)>& target, Index most_iterations);

/// Norm of scale_i v_i.
double scaled_norm(const std::vector<Vector>& v, const std::vector<double>& scale);

}  // namespace pfdm
