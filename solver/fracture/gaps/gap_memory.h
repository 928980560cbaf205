#pragma once
// What cells remember of the gaps at their faces, where their law forgets stress: in time (relaxing_gaps.h) or as they
// flow (flowing_gaps.h). A gap is the difference of the strain at a face from that of the cell (CellMechanics::gaps).
// Half the work of traction and gap is part of a cell's energy. Energies here are per volume of the cell [J/m^3].

#include "mesh/mesh.h"
#include "physics/materials/material.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/body/cell_mechanics.h"
#include "solver/momentum/small_strain/history_stress.h"

#include <memory>
#include <span>
#include <vector>

namespace pfdm {

class GapMemory {
 public:
  virtual ~GapMemory() = default;

  /// Whether there are cells that it is about, and whether this is one.
  virtual bool any() const = 0;
  virtual bool has(Index cell) const = 0;
  /// Count of the numbers that such a cell remembers.
  virtual std::size_t size(Index cell) const = 0;
  /// `duration` [s]; `shift`: a_T of every cell (temperature_shift.h); empty: 1.
  virtual void start_step(double duration, const CellField<double>& shift) = 0;

  /// Moduli that a change of gaps meets in the step, undamaged.
  virtual IsotropicElasticity elasticity(Index cell) const = 0;
  /// Writes the stress of what a cell remembers at the end of the step into a history with room for all cells.
  virtual void tell(Index cell, std::span<const double> numbers, HistoryStress& history) const = 0;
  /// From the numbers at the start of the step to those at its end if nothing moves; energies are left as they are.
  virtual void hold(Index cell, std::span<double> numbers) const = 0;
  /// From the numbers at the start of the step to those at the gaps and volume changes of now, of which the law leaves
  /// the share `left` of their stress by flowing (Material::left_by_flow).
  virtual void advance(Index cell, double left, const CellMechanics& now, std::span<const double> from,
                       std::span<double> to) = 0;

  /// Heat of the gaps since the virgin state, and their stored energy less half of the work of their traction [J/m^3].
  static double dissipated(std::span<const double> numbers) { return numbers[0]; }
  static double locked(std::span<const double> numbers) { return numbers[1]; }
  /// What springs of branches store at gaps [J/m^3].
  virtual double in_branches(std::span<const double>) const { return 0.0; }
};

/// The kinds that these materials need; null: elastic. No cell is of two.
std::vector<std::unique_ptr<GapMemory>> gap_memories(const Mesh& mesh, const CellField<const Material*>& materials,
                                                     const FractureModel& model);

}  // namespace pfdm
