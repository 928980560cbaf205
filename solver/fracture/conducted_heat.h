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

#include "solver/fracture/body_heat.h"
#include "solver/fracture/staggered.h"
#include "solver/heat/heat_equation.h"

#include <optional>
#include <vector>

namespace pfdm {

class ConductedHeat final : public BodyHeat {
 public:
  /// Of a model that has heat. Throws InputError for boundaries that are not of the mesh.
  ConductedHeat(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

  HeatState start(double duration) const override;
  void begin(HeatState& heat) const override {
    if (model_.is_warmed()) heat.felt = heat.rise;
  }
  void advance(const Staggered& staggered, const FractureState& from, double duration, FractureState& to) override;
  std::optional<HeatReport> report(const HeatState& heat) const override;
  double end_of_cycle(double load) const override;
  bool is_complete(const HeatState& heat) const override;
  std::vector<HeatRow> warm_by_cycles(const HeatState& heat, double time, Index n, CellField<double>& rise) override;
  void show(const HeatState& heat, std::vector<OutputHistory>& fields) const override;

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
  HeatEquation equation_;
};

}  // namespace pfdm
