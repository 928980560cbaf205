#pragma once
// Tractions at small strain of bodies with a history (viscoelastic, plastic, endochronic cells), linearised within each
// solve: sigma = C eps + sigma_0, for the stresses only. The a, b and c of the faces (isotropic_tractions.h) remain
// those of the elastic moduli. The converged solution therefore does not depend on C, which may change with the
// direction of the strain increment. There are no pressures and no faces of third order.

#include "physics/elasticity/linear_stress.h"
#include "solver/momentum/isotropic_tractions.h"

namespace pfdm {

class HistoryTractions final : public IsotropicTractions {
 public:
  using IsotropicTractions::IsotropicTractions;

  /// As IsotropicTractions::set(), with the stress of every cell.
  void set(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part,
           CellField<LinearStress> stress);

  void find_linear(const std::vector<Vector>& u, Sweep& sweep) const override;

 private:
  bool has_initial_stress() const override { return true; }
  Tensor initial_stress(Index cell) const override { return to_tensor(stress_[cell].initial); }
  Vector own_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                      const IsotropicSweep& s) const override;
  double stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const override;
  void add_reconstructed_strain(const Sweep& sweep, CellMechanics& result) const override;

  CellField<LinearStress> stress_;  // condensed in plane stress
};

}  // namespace pfdm
