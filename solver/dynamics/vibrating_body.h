#pragma once
// A linear elastic body that vibrates: K u = omega^2 M u with the stiffness K of the momentum balance (momentum.h) and
// the masses of the cells. The unknowns on faces and the pressures have no mass; K need not be symmetric.
//
// With one complex modulus c E for the whole body, at a real Poisson's ratio, the stiffness is c K: every response
// follows from A = K^-1 M, whose factors are made once.

#include "solver/dynamics/operator_matrix.h"
#include "solver/linear/sparse_lu.h"

#include <Eigen/Core>

namespace pfdm {

class VibratingBody {
 public:
  /// `density` [kg/m^3], one for each region of the mesh. Prescribed displacements are zero whatever the boundary
  /// conditions say. The arguments must outlive the body. Throws InputError like place_unknowns() and for a density
  /// that is not positive; ComputationError if the stiffness cannot be factored.
  VibratingBody(const Mesh& mesh, const ElasticBody& body, const std::vector<double>& density);

  const Mesh& mesh() const { return mesh_; }
  const Unknowns& unknowns() const { return unknowns_; }
  const MomentumOperator& balance() const { return balance_; }
  /// Three components of each unknown, in the order of the unknowns.
  Eigen::Index size() const { return mass_.size(); }
  /// Diagonal of M [kg]; zero on faces and pressures.
  const Eigen::VectorXd& mass() const { return mass_; }
  double total_mass() const { return total_mass_; }  ///< [kg]
  const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_; }
  double n_factor_entries() const { return factors_.n_entries(); }

  /// K^-1 f for forces on the unknowns [N], those on prescribed components left out.
  Eigen::VectorXd answer(Eigen::VectorXd force) const;
  /// A v = K^-1 M v.
  Eigen::VectorXd inertial_answer(const Eigen::VectorXd& v) const { return answer(mass_.cwiseProduct(v)); }
  /// The motion of all cells along a direction by one; zero on faces and pressures.
  Eigen::VectorXd rigid(const Vector& direction) const;
  /// u . M v [kg u v].
  double inner(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const { return u.dot(mass_.cwiseProduct(v)); }

 private:
  const Mesh& mesh_;
  Unknowns unknowns_;
  MomentumOperator balance_;
  Eigen::VectorXd mass_;
  double total_mass_;
  Eigen::SparseMatrix<double> stiffness_;
  SparseLu<double> factors_;
};

/// As the operator wants it.
std::vector<Vector> as_vectors(const Eigen::VectorXd& u);

}  // namespace pfdm
