#include "cases/program/vibration/mass_material_schedule.h"

#include "cases/program/input/config/key_member.h"

#include "cases/program/input/config/units.h"
#include "cases/program/vibration/mass_material_case.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

namespace pfdm {
namespace {

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

/// Columns of the levels of random motion, or of sines, and of what is done.
void add_motion(const MassMaterialCase& c, bool random, int planned, std::vector<std::vector<std::string>>& rows) {
  std::map<double, std::string> days;  // by level
  int done = 0;
  bool fractured = false;
  for (const VibrationTest& test : c.tests) {
    if (!test.schedule || (test.schedule->density > 0.0) != random) continue;
    const ScheduledRun& run = *test.schedule;
    std::string& text = days[random ? run.density : run.level];
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", run.day(), run.fractured ? "F" : "");
    fractured |= run.fractured;
    ++done;
  }
  for (const auto& [level, text] : days) {
    rows[0].push_back(random ? fmt::format("random, {:.4g} g0²/Hz, day", level / g0_squared)
                             : fmt::format("harmonic, {:.4g} g0, day", level / standard_gravity));
    rows[1].push_back(text);
  }
  if (done == 0 && planned == 0) return;
  rows[0].push_back(random ? "random, done of planned" : "harmonic, done of planned");
  rows[1].push_back(
      fmt::format("{}/{}{}", done, planned > 0 ? fmt::format("{}", planned) : "-", fractured ? " F" : ""));
}

ScheduledRun read_run(const ConfigTable& table, double band) {
  ScheduledRun run{.age = table.quantity("age"),
                   .run = static_cast<int>(table.integer("run", std::int64_t{1})),
                   .fractured = table.boolean("fractured", false)};
  const ConfigValue level = table.at("level");
  const bool of_density = level.is_string() && level.in_context([&] {
    return is_unit_of(unit_of(level.string()), dimension::acceleration_density);
  });
  if (of_density && !(band > 0.0))
    throw level.error(
        "a density belongs to random motion, but the excited band has no width: \"from\" must be below \"to\"");
  if (of_density) run.density = level.quantity(dimension::acceleration_density, range::positive);
  run.level = of_density ? std::sqrt(run.density * band) : level.quantity(dimension::acceleration, range::positive);
  return run;
}

}  // namespace

std::string read_date(const ConfigValue& value) {
  int year = 0, month = 0, day = 0, length = 0;
  std::string text = value.string();
  const bool fits = std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &length) == 3 && length == 10 &&
                    std::ssize(text) == length;
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!fits || !date.ok()) throw value.error(fmt::format("\"{}\" is no date; expected one as \"2016-09-14\"", text));
  return text;
}

SampleCard read_sample_card(const ConfigTable& root) {
  SampleCard card;
  if (!root.has("sample")) return card;
  const ConfigTable table = root.table("sample");
  read_stored(table, card);
  if (const auto cured = table.find("cured")) card.cured = read_date(*cured);
  return card;
}

ScheduledRun read_scheduled_run(const ConfigTable& table, std::string_view motion, double band) {
  ScheduledRun run = read_run(table, band);
  if (run.density > 0.0 && (motion == "swept_sine" || motion == "harmonic"))
    throw table.at("level").error(
        fmt::format("a density belongs to random motion; of a {} give the amplitude, as \"2 g0\"", motion));
  if (motion == "random" && run.density == 0.0) {
    if (!(band > 0.0)) throw table.error("the excited band has no width: \"from\" must be below \"to\"");
    run.density = run.level * run.level / band;
  }
  return run;
}

std::vector<std::vector<std::string>> schedule_rows(const MassMaterialCase& c) {
  const bool any = std::ranges::any_of(c.tests, [](const VibrationTest& test) { return test.schedule.has_value(); });
  if (!any) return {};
  std::vector<std::vector<std::string>> rows{{"sample"}, {c.card.name.empty() ? c.title : c.card.name}};
  for (const std::string& more : {c.card.composition, c.card.cured.empty() ? "" : "cured " + c.card.cured})
    if (!more.empty()) rows[1][0] += ", " + more;
  add_motion(c, true, c.card.planned_random, rows);
  add_motion(c, false, c.card.planned_harmonic, rows);
  return rows;
}

std::vector<SampleChange> read_sample_changes(const ConfigTable& root) {
  std::vector<SampleChange> changes;
  for (const ConfigTable& table : root.tables("change")) {
    changes.push_back({.damping = table.choice("of") == "damping"});
    read_stored(table, changes.back());
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
