#pragma once
// Memory of viscoelastic cells at finite strain (physics/materials/viscous_branches.h). Places are the cells, and then
// the sides that have a gradient of their own (FiniteStates::own): each has a history of its law, cells also one of the
// gaps at their faces and of their volume by the flux through these (relaxing_gaps.h), in the rotated frame of the
// cell.
//
// A law is a function of the deformation at the end of a step and of the history at its start. A step of no duration
// holds a state.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/gaps/relaxing_gaps.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include <vector>

namespace pfdm {

/// A cell, or side number `own` of those with a gradient of their own.
struct FinitePlace {
  Index cell = 0, own = -1;
};

class FiniteHistories {
 public:
  /// Of cells of these materials, null at small strain.
  FiniteHistories(const Mesh& mesh, const CellField<const HyperelasticMaterial*>& materials,
                  const FractureModel& model);

  bool any() const { return gaps_.any(); }
  bool has(Index cell) const { return gaps_.has(cell); }
  /// Names the cells of the sides that have a gradient of their own; before virgin_histories().
  void set_own_sides(std::vector<Index> cells);
  CellHistories virgin_histories() const;
  FinitePlace place(Index number) const {
    const Index own = number - mesh_.n_cells();
    return own < 0 ? FinitePlace{number} : FinitePlace{cells_of_own_[own], own};
  }

  /// a_T of every cell (temperature_shift.h) in the steps that follow; empty: 1.
  void shift_times(const CellField<double>& factor) { shift_ = factor; }
  /// Begins a step at these histories, which takes `duration` [s]; 0: holds them.
  void start_from(const CellHistories& start, double duration);
  /// What the place was at the start of the step; of a cell that has() one.
  PointBefore before(FinitePlace at) const {
    const Index k = number(at);
    return {start_.gradient(k), duration(at.cell), law_numbers(k, start_)};
  }
  const ViscousBranches& branches(Index cell) const {
    return is_plane_stress_ ? material_[cell]->branches() : material_[cell]->branches_of_cells();
  }
  /// Shear modulus of the branches that a small change of strain meets in the step [Pa].
  double modulus(Index cell) const { return modulus_[cell]; }
  /// Likewise bulk modulus [Pa].
  double bulk_modulus(Index cell) const { return bulk_modulus_[cell]; }
  /// What the branches have left of earlier gaps, by Mesh::cell_faces, sum mu_i left_i; empty: no cell relaxes [Pa].
  const std::vector<GapStress>& gaps() const { return left_.gaps; }
  /// Sum of mu_i times what is left of earlier volume strains, by the flux through the faces [Pa].
  double volume_left(Index cell) const { return left_.volumes[cell].by_flux; }

  /// Takes a place to its elastic gradient H of now.
  void advance(FinitePlace at, const Tensor& H, CellHistories& to) const;
  /// Takes the gaps of a cell, and its volume change by the flux J - 1, to those of now.
  void advance_gaps(Index cell, const std::vector<FaceGap>& gaps, double volume_change, CellHistories& to) const;
  /// Energies of the branches and gaps of a cell, undamaged; `idle` or `driving` as the material says, whole.
  MaterialEnergy energy(Index cell, const CellHistories& histories) const;
  /// That of the gaps which is stored beyond half the work of their tractions, alone.
  double locked(Index cell, const CellHistories& histories) const {
    return RelaxingGaps::locked(gap_numbers(cell, histories));
  }

 private:
  double duration(Index cell) const { return shift_.size() > 0 ? duration_ / shift_[cell] : duration_; }  // reduced
  Index number(FinitePlace at) const { return at.own < 0 ? at.cell : mesh_.n_cells() + at.own; }
  std::size_t law_size(Index number) const { return branches(place(number).cell).size(); }
  std::span<const double> law_numbers(Index number, const CellHistories& histories) const {
    return histories.of(number).first(law_size(number));
  }
  std::span<const double> gap_numbers(Index cell, const CellHistories& histories) const {
    return histories.of(cell).subspan(law_size(cell));
  }

  const Mesh& mesh_;
  CellField<const HyperelasticMaterial*> material_;
  bool is_plane_stress_ = false;
  RelaxingGaps gaps_;
  std::vector<Index> cells_of_own_;
  CellHistories start_;
  double duration_ = 0.0;
  HistoryStress left_;
  CellField<double> shift_;                   // may be empty
  CellField<double> modulus_, bulk_modulus_;  // of the step [Pa]
};

}  // namespace pfdm
