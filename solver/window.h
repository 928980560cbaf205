#pragma once
// A part of the mesh on which the staggered loop goes on alone, with the displacement around it held: where a crack's
// front advances cell by cell, what changes is near it. Near the cut, where the discrete balances see cells that are
// not there, the damage is held and what is missing acts as forces and sources (full approximation: Brandt, Math.
// Comput. 31 (1977) 333), so that a solution of the whole is one of the window.

#include "solver/staggered.h"

namespace pfdm {

/// Parts of the mesh that do not touch and that hold all cells within `reach` [m] of the seeds, by the way of faces;
/// around each of them the rings of cells whose damage is held. Cells in ascending order.
std::vector<std::vector<Index>> window_cells(const Mesh& mesh, const std::vector<Index>& seeds, double reach);

class Window {
 public:
  /// Where the loop of the whole stands. The damage equation was just solved from `state`, whose displacement is in
  /// equilibrium with its damage.
  struct Surroundings {
    const Mesh& mesh;
    const FractureModel& model;
    const Unknowns& unknowns;
    const FractureState& start;  ///< of the step
    const FractureState& state;
    const FaceField<Vector>& face_displacement;  ///< [m]
    const DamageEquation& damage_equation;
    CellStiffness& stiffness;
    double residual_reference;  ///< of the momentum balance
    double duration;            ///< of the step [s]
  };

  /// Of such cells as window_cells gives. Must not outlive what surrounds it.
  Window(const Surroundings& whole, std::vector<Index> cells, const StaggeredSettings& settings);

  /// Iterates within the window from `state`, and leaves there what it comes to.
  StepOutcome settle(FractureState& state);

 private:
  void hold_rim();
  void agree();
  void hold_rim_as_it_was(FractureState& here) const;
  FractureState take_out_state(const FractureState& whole) const;
  void put_back_state(const FractureState& here, FractureState& whole) const;

  const Surroundings whole_;
  MeshPart part_;
  FractureModel model_;
  Unknowns unknowns_;
  Staggered staggered_;
  FractureState start_;
};

}  // namespace pfdm
