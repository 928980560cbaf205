#include "cases/program/vibration/mass_material_schedule.h"

#include "cases/program/input/units.h"
#include "cases/program/vibration/mass_material_case.h"
#include "solver/vibration/vibration_excitation.h"

#include <fmt/format.h>

#include <array>

namespace pfdm {
namespace {

constexpr Range run_number{1.0, 1e6, false, "1 or more"};
constexpr Range relative_slope{-1.0, 1.0, false, "between -1 and 1"};
constexpr Range relative_scatter{0.0, 0.5, false, "between 0 and 0.5"};

/// Level in g0, age in days, run.
std::array<double, 3> coordinates_of(const ScheduledRun& s) {
  return {s.level_in_g0(), s.age_in_days(), static_cast<double>(s.run)};
}

/// Of the tests that have a schedule.
std::array<double, 3> mean_coordinates(const MassMaterialCase& c) {
  std::array<double, 3> mean{};
  double n = 0.0;
  for (const VibrationTest& test : c.tests) {
    if (!test.schedule) continue;
    const auto at = coordinates_of(*test.schedule);
    n += 1.0;
    for (std::size_t k = 0; k < 3; ++k) mean[k] += (at[k] - mean[k]) / n;
  }
  return mean;
}

}  // namespace

ScheduledRun read_scheduled_run(const ConfigTable& table) {
  table.with_keys({"level", "age", "run"});
  return {.level = table.quantity("level", dimension::acceleration, range::positive),
          .age = table.quantity("age", dimension::time, range::not_negative),
          .run = static_cast<int>(table.integer("run", run_number))};
}

std::vector<SampleChange> read_sample_changes(const ConfigTable& root) {
  const std::string parameters[] = {"stiffness", "damping"};
  std::vector<SampleChange> changes;
  for (const ConfigTable& table : root.tables("change")) {
    table.with_keys({"of", "per_g0", "per_day", "per_run", "scatter"});
    changes.push_back({.damping = table.at("of").one_of(parameters, "parameter that changes") == "damping",
                       .per_g0 = table.number("per_g0", relative_slope, 0.0),
                       .per_day = table.number("per_day", relative_slope, 0.0),
                       .per_run = table.number("per_run", relative_slope, 0.0),
                       .scatter = table.number("scatter", relative_scatter, 0.0)});
  }
  return changes;
}

MassMaterial sample_of_test(const MassMaterialCase& c, std::size_t number) {
  MassMaterial m = c.model;
  const auto& schedule = c.tests[number].schedule;
  if (!schedule) return m;
  const auto at = coordinates_of(*schedule), mean = mean_coordinates(c);
  for (std::size_t i = 0; i < c.changes.size(); ++i) {
    const SampleChange& change = c.changes[i];
    const double normal = normal_numbers(2, 1000 * c.noise_seed + 10 * number + i)[0];
    const double factor = 1.0 + change.per_g0 * (at[0] - mean[0]) + change.per_day * (at[1] - mean[1]) +
                          change.per_run * (at[2] - mean[2]) + change.scatter * normal;
    if (!(factor > 0.0))
      throw InputError(
          fmt::format("[[change]]: test {} would have {:.3g} times the {} of [model]; the factor must be positive",
                      c.tests[number].name, factor, change.damping ? "damping" : "stiffness"));
    if (change.damping) {
      m.damping *= factor;
      continue;
    }
    for (double& k : m.stiffness) k *= factor;
    for (HereditaryTerm& term : m.kernel) term.beta *= factor;
  }
  return m;
}

void require_schedule(const MassMaterialCase& c, const ConfigValue& asked) {
  if (c.fit.method != "output_error") throw asked.error("repeatability requires the method \"output_error\"");
  std::vector<ScheduledRun> schedule;
  for (const VibrationTest& test : c.tests) {
    if (test.predicted) continue;
    if (!test.schedule)
      throw test.where->error(
          fmt::format("test {} has no schedule = {{ level, age, run }}, which [fit] repeatability "
                      "needs of every test that is fitted",
                      test.name));
    schedule.push_back(*test.schedule);
  }
  if (schedule.size() < 3)
    throw asked.error(fmt::format("{} tests are fitted; at least 3 are required", schedule.size()));
  if (const auto names = confounded(schedule))
    throw asked.error(fmt::format("in this schedule the effects of {} cannot be separated", *names));
}

}  // namespace pfdm
