#pragma once
// What fatigue does to a run. BodyFatigue is that of a body whose cells do not tire: nothing. The fatigue of cells is
// in fatigue_cells.h.

#include "mesh/mesh.h"
#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

class FatigueWork;

class BodyFatigue {
 public:
  BodyFatigue() = default;
  virtual ~BodyFatigue() = default;
  BodyFatigue(const BodyFatigue&) = delete;
  BodyFatigue& operator=(const BodyFatigue&) = delete;

  virtual FatigueState virgin() const { return {}; }
  /// Gives the damage equation the toughness that fatigue has left in a state.
  virtual void set_toughness(const FractureState&, DamageEquation&) const {}
  /// Fatigue of the step that ends with this state in equilibrium, at which damage degrades psi_plus [J/m^3]. The
  /// toughness of the damage equation falls accordingly.
  virtual void end_step(const CellField<double>&, DamageEquation&, FractureState&) const {}
  /// The part of the surface energy that FatigueState::spent counts [J]; exactly 0 while no f has fallen.
  virtual double spent_energy(const FatigueState&) const { return 0.0; }
  /// Adds it, per volume of the cells, to a density [J/m^3].
  virtual void add_spent(const FatigueState&, CellField<double>&) const {}

  /// The next load at which a step has to end: that of a part of a cycle, or `stop`, another that must not be passed,
  /// whichever is first. Two that differ by rounding are one, `stop`.
  virtual double next_stop(double, double stop) const { return stop; }
  /// Takes note of a whole cycle, if one ends at this load and has not been counted.
  virtual void end_cycle(double, FatigueState&) const {}
  /// Number of cycles by which a state may jump: by the tolerance, and so that a whole cycle is left before `stop`, the
  /// next load that must not be passed. 0: the next step goes on as usual.
  virtual double cycles_to_jump(const FractureState&, double) const { return 0.0; }
  /// Jumps over so many cycles; the load grows by what they take, and the toughness of the damage equation falls.
  virtual void jump(double, DamageEquation&, FractureState&) const {}

  virtual std::optional<FatigueReport> report(const FractureState&) const { return std::nullopt; }
  /// The warning of FatigueWork after a step to this state.
  virtual std::string remark(FatigueWork&, const FractureState&) const { return {}; }
  /// Adds alpha_bar and f to the fields of the output.
  virtual void show(const FatigueState&, std::vector<OutputHistory>&) const {}
};

/// Keeps references to both.
std::unique_ptr<BodyFatigue> make_body_fatigue(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
