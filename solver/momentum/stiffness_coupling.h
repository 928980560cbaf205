#pragma once
// The derivative of the momentum balance by the stiffness factors g of the cells, and that of the cells' energies by
// the displacement. With tau the traction that the part of a cell's stiffness which g multiplies has on a face, at the
// face displacement u_f at which both sides agree (isotropic_tractions.h),
//
//   dt = b (a+b)^-1 tau_P dg_P + a (a+b)^-1 tau_N dg_N,
//   d(V psi_c) = sum A tau.(du_f - du_c),  du_f = (that of du) - (a+b)^-1 (tau_P dg_P - tau_N dg_N):
//
// the two are each other's transpose up to what the operator itself is not symmetric by. The weights of the
// least-squares gradients, which also depend on g, are taken as constant.

#include "solver/momentum/momentum.h"
#include "solver/momentum/small_strain/isotropic_tractions.h"

namespace pfdm {

class StiffnessCoupling {
 public:
  /// Whether the formulas hold: not where other stiffnesses than a, b stand in the jump terms (polyhedra), nor with
  /// pressures or in axisymmetric sectors.
  static bool covers(const Mesh& mesh, const Unknowns& unknowns);

  /// Coupling at the displacement u; `part` is the stiffness that g multiplies, zero where nothing is. For use while
  /// `balance` exists and keeps its moduli, which are isotropic.
  StiffnessCoupling(const MomentumOperator& balance, CellField<IsotropicElasticity> part, const std::vector<Vector>& u);

  /// The changes by du and dg: of A u [N], and of the energies V psi [J] of the cells' parts.
  void apply(const std::vector<Vector>& du, const CellField<double>& dg, std::vector<Vector>& force,
             CellField<double>& energy);
  /// Change of A u by dg alone [N].
  void apply(const CellField<double>& dg, std::vector<Vector>& force) const;

 private:
  void find_tractions(const CellField<IsotropicElasticity>& part, const std::vector<Vector>& u);

  const MomentumOperator& balance_;
  const FaceSkeleton& skeleton_;
  const IsotropicTractions& tractions_;
  std::vector<Vector> tau_P_, tau_N_;    // per link, along its normal, times the area [N]
  std::vector<Vector> tau_;              // per side, outwards, likewise
  std::vector<double> gain_P_, gain_N_;  // per link: change of the energies of its cells [J]
  std::vector<double> gain_;             // per side
  std::vector<Vector> by_stiffness_;     // work space
};

}  // namespace pfdm
