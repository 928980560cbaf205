#pragma once
// Temperatures of the cells, and what they do to relaxing materials: [loads] start_temperature, the change of
// temperature that is prescribed, and the rise by heat that is felt (two-way heat).

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

namespace pfdm {

class CellTemperature {
 public:
  /// Keeps references to both.
  CellTemperature(const Mesh& mesh, const FractureModel& model);

  /// Whether the times of some material depend on the temperature.
  bool shifts() const { return shifts_; }
  /// a_T of every cell (temperature_shift.h) in a step from a state to this load, by the temperature halfway and the
  /// rise at its start; empty if no material has one.
  CellField<double> factors(const FractureState& from, double load) const;
  /// Change of the complex shear modulus at an angular frequency [1/s], its real or imaginary part relative, from the
  /// rises `before` to those of now [K], at this load: the largest of all cells.
  double change_of_moduli(const CellField<double>& before, const CellField<double>& now, double load,
                          double angular_frequency) const;

 private:
  double temperature(Index cell, double load, double rise) const;  // [K]
  const TemperatureShift* shift(Index cell) const { return model_.in_cell(mesh_, cell).temperature_shift(); }

  const Mesh& mesh_;
  const FractureModel& model_;
  bool shifts_ = false;
};

}  // namespace pfdm
