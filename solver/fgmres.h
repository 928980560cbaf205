#pragma once
// Flexible GMRES (Saad, SIAM J. Sci. Comput. 14 (1993) 461) with restarts. The basis is kept in single precision; the
// iterate, the operator and the residual at every restart are double, so the residual that is reported is true.

#include "physics/tensor.h"

#include <functional>
#include <vector>

namespace pfdm {

struct KrylovResult {
  bool converged = false;
  Index iterations = 0;
  double initial_residual = 0.0;  ///< scaled norm at the start
  double residual = 0.0;          ///< at the end: true, or the recurrence's while the drop within a cycle is modest
};

struct KrylovProblem {
  /// y = A x.
  std::function<void(const std::vector<Vector>& x, std::vector<Vector>& y)> apply;
  /// z = approximately A^-1 r.
  std::function<void(const std::vector<Vector>& r, std::vector<Vector>& z)> precondition;
  /// Restores what x must hold exactly and the basis, in single precision, does not; may be empty.
  std::function<void(std::vector<Vector>& x)> constrain = {};
  /// The norm is that of scale_i r_i.
  std::vector<double> scale;
  Index restart_length = 40;  ///< vectors of a cycle
};

/// Improves x until the scaled residual of A x = b is at most target(initial residual), in at most `most_iterations`.
/// A drop of less than four orders within a cycle is taken from the recurrence, which single precision cannot have
/// falsified; beyond, the residual is computed again.
KrylovResult solve_fgmres(const KrylovProblem& problem, const std::vector<Vector>& b, std::vector<Vector>& x,
                          const std::function<double(double initial)>& target, Index most_iterations);

/// Norm of scale_i v_i.
double scaled_norm(const std::vector<Vector>& v, const std::vector<double>& scale);

}  // namespace pfdm
