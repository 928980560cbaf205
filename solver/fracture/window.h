#pragma once
// Local sub-domain iteration: the staggered loop on a part of the mesh, with the displacement around it held. Where a
// crack front advances cell by cell, only its neighbourhood changes. Near the cut, where the discrete balances involve
// cells outside the window, the damage is held and the missing contributions act as forces and sources (full
// approximation scheme: Brandt, Math. Comput. 31 (1977) 333), so that a solution of the whole problem is also one of
// the window.

#include "solver/fracture/staggered.h"

namespace pfdm {

/// Disjoint, non-adjacent parts of the mesh that contain all cells within `reach` [m] of the seeds, reached through
/// faces; each with the surrounding rings of cells whose damage is held. Cells in ascending order.
std::vector<std::vector<Index>> window_cells(const Mesh& mesh, const std::vector<Index>& seeds, double reach);

class Window {
 public:
  /// The damage equation of `whole` has just been solved from `turn.from`, whose displacement is in equilibrium with
  /// its damage. `cells` is one of the parts of window_cells. Must not outlive what it is given.
  Window(Staggered& whole, const LocalIterations::Turn& turn, std::vector<Index> cells,
         const StaggeredSettings& settings);

  /// Iterates within the window from `state` and writes the result back to it.
  StepOutcome settle(FractureState& state);

 private:
  CellField<char> held_cells() const;
  void take_away_free_forces(std::vector<Vector>& force) const;
  void agree();
  void hold_rim_as_it_was(FractureState& here) const;
  FractureState take_out_state(const FractureState& whole) const;
  void put_back_state(const FractureState& here, FractureState& whole) const;

  Staggered& whole_;
  const LocalIterations::Turn turn_;
  MeshPart part_;
  FractureModel model_;
  Unknowns unknowns_;
  Staggered staggered_;
  FractureState start_;
  CellField<char> held_;  // not zero in the rim
};

/// Windows around the cells whose damage changes most.
class Windows : public LocalIterations {
 public:
  bool iterate(Staggered& whole, const Turn& turn, FractureState& state, StepOutcome& outcome) override;
};

}  // namespace pfdm
