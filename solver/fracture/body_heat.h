#pragma once
// What heat does to a run. BodyHeat is that of a body without: nothing. Heat that is conducted is in conducted_heat.h.

#include "solver/fracture/staggered.h"

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace pfdm {

class BodyHeat {
 public:
  BodyHeat() = default;
  virtual ~BodyHeat() = default;
  BodyHeat(const BodyHeat&) = delete;
  BodyHeat& operator=(const BodyHeat&) = delete;

  virtual HeatState start(double) const { return {}; }  ///< of a load parameter of 1 [s]
  /// Begins a step: the body feels the rises of now, if they act on it.
  virtual void begin(HeatState&) const {}
  /// Takes the heat from a state to the one at the end of a step of this duration [s], of which all else is known.
  virtual void advance(const Staggered&, const FractureState&, double, FractureState&) {}
  virtual std::optional<HeatReport> report(const HeatState&) const { return std::nullopt; }
  /// The load at which the cycle under way ends; infinite without cycles.
  virtual double end_of_cycle(double) const { return std::numeric_limits<double>::infinity(); }
  /// Whether the last whole cycle made the same heat everywhere as the one before; with rises that act on the body and
  /// a long time, whether that has gone by.
  virtual bool is_complete(const HeatState&) const { return false; }
  /// From rise zero on, one-way: FractureRun::warm_by_cycles(). Throws ComputationError without a whole cycle.
  virtual std::vector<HeatRow> warm_by_cycles(const HeatState& heat, double time, Index n, CellField<double>& rise);
  /// Adds the rise and what has been made to the fields of the output.
  virtual void show(const HeatState&, std::vector<OutputHistory>&) const {}
};

/// Keeps references to both. Throws InputError for boundaries of the heat that are not of the mesh.
std::unique_ptr<BodyHeat> make_body_heat(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

}  // namespace pfdm
