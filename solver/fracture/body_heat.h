#pragma once
// Heat where a body dissipates: in materials (viscous, plastic), by the viscosity of the damage equation, and on
// cohesive interfaces (friction, decohesion). The dissipation of a load step goes into cells and interface faces and is
// conducted in the time of the step (solver/heat). Surface energy of the phase field is no heat, nor is what a strength
// model's driving force does. Cracks conduct as sound material does. At finite strain all of it is per reference volume
// and area, and the conduction that of the undeformed body.
//
// One-way, rises strain nothing and change no modulus. Two-way, a step feels the rises at its start, as expansion and
// in the times of materials (cell_temperature.h): of first order in the step. Where the load has cycles and a long time
// is looked at, a cycle that repeats stands for the time in which its mean heat changes the moduli, or then turns out
// to have changed the heat of a cycle, by a small share. Then it is gone through again.

#include "solver/fracture/staggered.h"
#include "solver/heat/heat_equation.h"

#include <memory>
#include <vector>

namespace pfdm {

class BodyHeat {
 public:
  /// Without heat in the model nothing below does anything. Throws InputError for boundaries that are not of the mesh.
  BodyHeat(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

  bool any() const { return equation_ != nullptr; }
  HeatState start(double duration) const;  ///< of a load parameter of 1 [s]
  /// Begins a step: the body feels the rises of now, if they act on it.
  void begin(HeatState& heat) const {
    if (model_.is_warmed()) heat.felt = heat.rise;
  }
  /// Takes the heat from a state to the one at the end of a step, of which all else is known.
  void advance(const Staggered& staggered, const FractureState& from, double duration, FractureState& to);
  HeatReport report(const HeatState& heat) const;
  /// The load at which the cycle under way ends; infinite without cycles.
  double end_of_cycle(double load) const;
  /// Whether the last whole cycle made the same heat everywhere as the one before; with rises that act on the body and
  /// a long time, whether that has gone by.
  bool is_complete(const HeatState& heat) const;
  /// From rise zero on, one-way.
  std::vector<HeatRow> warm_by_cycles(const HeatState& heat, double time, Index n, CellField<double>& rise);
  /// Adds the rise and what has been made to the fields of the output.
  void show(const HeatState& heat, std::vector<OutputHistory>& fields) const;

 private:
  void end_cycle(double duration, HeatState& heat) const;
  bool repeats(const HeatState& heat) const { return heat.cycle_change <= model_.heat->repeats_within; }
  void warm_on(const CellTemperature& temperature, double load, HeatState& heat);
  double longest_stretch(const HeatState& heat) const;
  double relative_change(const CellField<double>& before, const CellField<double>& now) const;
  CellField<double> mean_power(const HeatState& heat) const;
  std::vector<double> transmittance(const std::vector<char>& parted) const;

  const Mesh& mesh_;
  const FractureModel& model_;
  std::unique_ptr<HeatEquation> equation_;
};

}  // namespace pfdm
