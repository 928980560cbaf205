#pragma once
// A material point under mixed control: six linear conditions between stress and strain, which in the simplest case
// prescribe six of their twelve components. Solved for the strain increment by Newton's method with the law's
// consistent tangent; where that fails the increment is halved.

#include "physics/point/endochronic.h"

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// on_stress . sigma + on_strain . eps = value, in Mandel components; [Pa] if stress takes part, [-] otherwise.
struct ControlCondition {
  Mandel on_stress = Mandel::Zero();
  Mandel on_strain = Mandel::Zero();
};

enum class Pace {
  follow,    ///< the value itself is prescribed at each time
  ramp,      ///< linearly from what it is when the segment begins to the last value
  increment  ///< its change is prescribed: the difference of the values
};

/// A part of the loading during which the same six conditions hold.
struct LoadSegment {
  struct Condition {
    ControlCondition condition;
    Pace pace = Pace::ramp;
    std::vector<double> values;  ///< at `times`; of a ramp the last one alone
  };
  std::array<Condition, 6> conditions;
  std::vector<double> times;  ///< from the beginning of the segment to its end, one more than increments [s]
};

struct ControlSettings {
  int maximum_iterations = 25;
  int maximum_halvings = 12;
  double tolerance = 1e-12;  ///< of a condition, relative to the strain increment
  double largest_increment = std::numeric_limits<double>::infinity();  ///< of a prescribed strain, else it is cut
  int substeps = 1;  ///< that each increment, or what it is cut into, is divided into
};

struct ControlledStep {
  EndochronicUpdate update;
  int iterations = 0;
  bool converged = false;
};

/// One step in which the values of the six conditions change by `change`. Not converged if Newton's method is not, as
/// for stresses that the material cannot sustain. `guess`: of the strain increment, used if it is better than none.
ControlledStep controlled_step(const EndochronicLaw& law, const EndochronicState& state,
                               const std::array<ControlCondition, 6>& conditions, const Mandel& change, double dt,
                               const ControlSettings& settings = {}, const Mandel& guess = Mandel::Zero());

/// Why the conditions cannot determine a step, if so: they contradict or repeat one another.
std::optional<std::string> dependent_conditions(const EndochronicLaw& law,
                                                const std::array<ControlCondition, 6>& conditions);

struct HistoryPoint {
  double time = 0.0;  ///< [s]
  Mandel stress = Mandel::Zero();
  EndochronicState state;
  int iterations = 0;  ///< of Newton's method, all substeps
  int substeps = 0;
};

struct HistoryResult {
  std::vector<HistoryPoint> points;  ///< the first is the state at the beginning
  bool converged = true;
  std::string failure;  ///< why not, with the time
};

/// The whole loading from virgin material. Ends, not converged, where the strain has left those that are prescribed by
/// more than 1: a law of small strains cannot follow the stresses. `seen` is called after each increment.
HistoryResult run_history(const EndochronicLaw& law, const std::vector<LoadSegment>& segments,
                          const ControlSettings& settings = {},
                          const std::function<void(const HistoryPoint&)>& seen = {});

}  // namespace pfdm
