#pragma once
// The schedule of repeated vibration tests: when and how hard each was; and, for synthetic records, how the sample
// changes over it.

#include "cases/program/input/config/config.h"
#include "physics/point/mass_material.h"
#include "solver/vibration/diagnosis/repeatability.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct MassMaterialCase;

/// A date as ISO 8601 has it, "2016-09-14", so that dates sort.
std::string read_date(const ConfigValue& value);

/// schedule = { level = "5 g0", age = "7 day", run = 1 }; the level of random motion may be its density in its band
/// [Hz], level = "0.05 g0^2/Hz". `motion`: the type of the excitation; where it leaves open what motion it is
/// ("measured", or empty for a record alone), the unit of the level decides.
ScheduledRun read_scheduled_run(const ConfigTable& table, std::string_view motion, double band);

/// [sample] of a schedule of tests.
struct SampleCard {
  std::string name;         ///< "P85_S070_A30_C03"
  std::string composition;  ///< in words
  std::string cured;        ///< date of day 0, "2016-06-13"
  int planned_random = 0, planned_harmonic = 0;
};
SampleCard read_sample_card(const ConfigTable& root);

/// The status of the tests as a row of the report's Table A1: days of the tests at each level, F where the sample
/// broke, and how many of those planned are done. First row: names of the columns. Nothing if no test has a schedule.
std::vector<std::vector<std::string>> schedule_rows(const MassMaterialCase& c);

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
