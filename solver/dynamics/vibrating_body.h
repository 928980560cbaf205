#pragma once
// A linear elastic body that vibrates: K u = omega^2 M u with the stiffness K of the momentum balance (momentum.h) and
// the masses of the cells. The unknowns on faces and the pressures have no mass; K need not be symmetric.
//
// With one complex modulus c E for the whole body, at a real Poisson's ratio, the stiffness is c K: every response
// follows from A = K^-1 M. Of small bodies K is factored once; of larger ones each A v is solved for iteratively
// (spline_solver.h).
//
// A body that nothing holds has rigid motions, and no K^-1. With a shift s > 0 A is (K + s M)^-1 M, whose eigenvalues
// are 1/(omega^2 + s).

#include "solver/dynamics/operator_matrix.h"
#include "solver/linear/sparse_lu.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <Eigen/Core>

#include <optional>

namespace pfdm {

struct VibrationSettings {
  double shift = 0.0;          ///< s [rad^2/s^2]; more than 0: the body may float, and is factored whatever its size
  Index most_factored = 7000;  ///< cells; meshes one cell thick: prefers_direct() (preconditioner.h)
  double tolerance = 1e-7;     ///< of the residual of iterative solutions, relative to the force
};

class VibratingBody {
 public:
  /// `density` [kg/m^3], one for each region of the mesh. Prescribed displacements are zero whatever the boundary
  /// conditions say, and no tractions are applied. The mesh must outlive the body. Throws InputError like
  /// place_unknowns() and for a density that is not positive; ComputationError if the stiffness cannot be factored.
  VibratingBody(const Mesh& mesh, const ElasticBody& body, const std::vector<double>& density,
                const VibrationSettings& settings = {});

  const Mesh& mesh() const { return mesh_; }
  const Unknowns& unknowns() const { return unknowns_; }
  const MomentumOperator& balance() const { return solver_ ? solver_->balance() : *balance_; }
  /// Three components of each unknown, in the order of the unknowns.
  Eigen::Index size() const { return mass_.size(); }
  /// Diagonal of M [kg]; zero on faces and pressures.
  const Eigen::VectorXd& mass() const { return mass_; }
  double total_mass() const { return total_mass_; }  ///< [kg]
  double shift() const { return settings_.shift; }   ///< s [rad^2/s^2]
  /// K as a matrix, made anew at each call.
  Eigen::SparseMatrix<double> stiffness() const { return matrix_of(mesh_, unknowns_, balance()); }
  /// How A v is found, for the log.
  std::string method() const;

  /// (K + s M)^-1 f for forces on the nodes [N], those on prescribed components left out. Throws ComputationError if an
  /// iterative solution does not converge.
  Eigen::VectorXd answer(Eigen::VectorXd force) const;
  /// A v.
  Eigen::VectorXd inertial_answer(const Eigen::VectorXd& v) const { return answer(mass_.cwiseProduct(v)); }
  /// The motion of all cells along a direction by one; zero on faces and pressures.
  Eigen::VectorXd rigid(const Vector& direction) const;
  /// u . M v [kg u v].
  double inner(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const { return u.dot(mass_.cwiseProduct(v)); }

 private:
  Eigen::VectorXd iterative_answer(const Eigen::VectorXd& force) const;

  const Mesh& mesh_;
  VibrationSettings settings_;
  Unknowns unknowns_;
  std::optional<MomentumOperator> balance_;       // of a body that is factored; the other has
  mutable std::optional<MomentumSolver> solver_;  // this, whose work space and counters change
  Eigen::VectorXd mass_;
  double total_mass_;
  std::optional<SparseLu<double>> factors_;
  mutable Index n_solutions_ = 0, n_iterations_ = 0;
};

/// As the operator wants it.
std::vector<Vector> as_vectors(const Eigen::VectorXd& u);

}  // namespace pfdm
