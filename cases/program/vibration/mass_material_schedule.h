#pragma once
// The schedule of repeated vibration tests: when and how hard each was; and, for synthetic records, how the sample
// changes over it.

#include "cases/program/input/config.h"
#include "physics/mass_material.h"
#include "solver/vibration/repeatability.h"

#include <string>
#include <vector>

namespace pfdm {

struct MassMaterialCase;

/// schedule = { level = "5 g0", age = "7 day", run = 1 }
ScheduledRun read_scheduled_run(const ConfigTable& table);

/// How a simulated sample moves away from [model], in parts of the parameter, about the schedule's means.
struct SampleChange {
  bool damping = false;  ///< of c; otherwise of all k_i and beta
  double per_g0 = 0.0;
  double per_day = 0.0;
  double per_run = 0.0;
  double scatter = 0.0;  ///< standard deviation from test to test
};
std::vector<SampleChange> read_sample_changes(const ConfigTable& root);

/// The model that a test is simulated with.
MassMaterial sample_of_test(const MassMaterialCase& c, std::size_t number);

/// Throws InputError where a fit's repeatability cannot be determined from the tests that are fitted.
void require_schedule(const MassMaterialCase& c, const ConfigValue& asked);

}  // namespace pfdm
