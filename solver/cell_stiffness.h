#pragma once
// The stiffness of damaged cells, which depends on the strain where the energy split keeps compression. Within the
// momentum solve it is linear, taken at the last strain: secant moduli where the split has isotropic ones, else its
// tangent, which is the secant as well (energies of second degree), so that the solves are Newton's steps.

#include "solver/fracture_model.h"
#include "solver/momentum_solver.h"
#include "solver/state.h"

namespace pfdm {

class CellStiffness {
 public:
  CellStiffness(const Mesh& mesh, const FractureModel& model);

  /// At the beginning of a load step: forgets in what manner the strains moved in the one before.
  void start_step();
  /// Gives the momentum balance the stiffness that belongs to the damage, closure and tangent strain of the state.
  void set(const FractureState& state, MomentumSolver& momentum) const;
  /// Has the closure or the tangent strain of the state follow these strains. Returns the energy [J] by which the
  /// stiffness that was used falsifies them.
  double follow(const CellField<Tensor>& strain, FractureState& state);

 private:
  double factor(Index cell, double d) const;  // g, the residual stiffness included
  const IsotropicElasticity& elasticity(Index cell) const;
  double follow_with_closure(Index cell, const Tensor& strain, double d, double& closure);
  double follow_with_tangent(Index cell, const Tensor& strain, double d, Tensor& tangent_strain);

  const Mesh& mesh_;
  const FractureModel& model_;
  CellField<float> closing_;  // per cell: last move of the closure, and
  CellField<Index> turns_;    // how often it has turned within the step
  CellField<Tensor> move_;    // last move of the tangent strain, and
  CellField<float> share_;    // the part of it that the cell may take
};

}  // namespace pfdm
