#pragma once
// Heat where a body dissipates: in materials (viscous, plastic), by the viscosity of the damage equation, and on
// cohesive interfaces (friction, decohesion). The dissipation of a load step goes into cells and interface faces and is
// conducted in the time of the step (solver/heat). Surface energy of the phase field is no heat, nor is what a strength
// model's driving force does. The way is one-way: temperatures strain nothing and change no modulus. Cracks conduct as
// sound material does.

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
  /// Takes the heat from a state to the one at the end of a step, of which all else is known.
  void advance(const Staggered& staggered, const FractureState& from, double duration, FractureState& to);
  HeatReport report(const HeatState& heat) const;
  /// The load at which the cycle under way ends; infinite without cycles.
  double end_of_cycle(double load) const;
  /// Whether the last whole cycle made the same heat everywhere as the one before.
  bool repeats(const HeatState& heat) const;
  /// From rise zero on.
  std::vector<HeatRow> warm_by_cycles(const HeatState& heat, double time, Index n, CellField<double>& rise);
  /// Adds the rise and what has been made to the fields of the output.
  void show(const HeatState& heat, std::vector<OutputHistory>& fields) const;

 private:
  void end_cycle(double duration, HeatState& heat) const;
  std::vector<double> transmittance(const std::vector<char>& parted) const;

  const Mesh& mesh_;
  const FractureModel& model_;
  std::unique_ptr<HeatEquation> equation_;
};

}  // namespace pfdm
