// Events of a fit beside its other parts: first guess, stages, set-up, preparation of the record, commands without
// them.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/page/fit_on_page.h"
#include "cases/program/input/case_files/case_file.h"
#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "tests/cases/broken_bar.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

namespace pfdm::this_file {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The bar of the first guess is so tough that it does not break within the run.
TEST(EventSides, AreAsExactWhateverTheFirstGuess) {
  const std::string text = replaced(event_fit(), "\"100 J/m^2\"", "\"200 J/m^2\"");
  const TemporaryCase directory(replaced(text, "\"80 J/m^2\"", "\"160 J/m^2\""));
  const auto fit = fitted_to_broken_bar(directory);
  const auto& displacement = event_figure(fit["events"][0], "displacement");
  const double deviation = std::hypot(row_spacing, load_step) / std::sqrt(12.0);
  EXPECT_NEAR(displacement["deviation"].get<double>(), deviation, 0.02 * deviation);
}

// Where the runs end at 8 um the force is greatest there.
TEST(EventSides, AreThoseOfTheStagesRuns) {
  const TemporaryCase directory(
      event_fit("event = \"greatest_force\"\ndisplacement = { value = \"6 um\", deviation = \"1 um\" }\n") +
      "[[fit.stages]]\nname = \"elastic\"\nbetween = [\"0 um\", \"8 um\"]\n");
  const auto fit = fitted_to_broken_bar(directory);
  EXPECT_FALSE(fit["events"][0]["in_computed_curve"].get<bool>());
  EXPECT_NEAR(event_figure(fit["events"][0], "displacement")["computed"].get<double>(), 8e-6, 1e-12);
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("it has not reached the greatest force of one"));
}

TEST(EventSides, AreOfNoConcernToRunsAndComparisons) {
  const TemporaryCase directory(event_fit("event = \"jump\"\nnumber = 3\n"));
  broken_bar().write(directory);
  for (const char* command : {"run", "compare"}) {
    const Outcome outcome = run({command, directory.path().string(), "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
}

// The file has twice the displacements, 4 um later, and half the forces with another sign.
TEST(EventSides, AreStatedInTheNumbersOfTheFile) {
  std::string text = event_fit(
      "event = \"jump\"\ndisplacement = { value = \"27.75 um\", deviation = \"0.2 um\" }\n"
      "force_before = { value = \"-6 N\", deviation = \"0.1 N\" }\n");
  text = replaced(text, "{ column = \"displacement_m\" }", "{ column = \"displacement_m\", factor = 0.5 }");
  text = replaced(text, "{ column = \"force_N\" }", "{ column = \"force_N\", factor = -2 }");
  text = replaced(text, "[[experiment.specimens]]\n", "toe = [\"4 N\", \"12 N\"]\n[[experiment.specimens]]\n");
  const TemporaryCase directory(text);
  CsvTable rows = broken_bar().rows;
  for (double& u : rows.columns[0]) u = 2.0 * (u + 2e-6);
  for (double& force : rows.columns[1]) force *= -0.5;
  write_csv(directory.path() / "data.csv", rows);
  const CaseFile file = open_case(directory.path());
  const auto experiment = read_experiment(file.config.root(), file.directory);
  const std::vector<MeasuredEvent> events = events_in_records(experiment->events, experiment->specimens);
  const double origin = experiment->specimens[0].origin;
  EXPECT_NEAR(origin, 2e-6, 0.5e-6);  // by noisy rows
  ASSERT_EQ(events[0].figures.size(), 2u);
  EXPECT_NEAR(events[0].place, 0.5 * 27.75e-6 - origin, 1e-15);
  EXPECT_NEAR(events[0].figures[0].deviation, 0.1e-6, 1e-15);
  EXPECT_NEAR(events[0].figures[1].value, 12.0, 1e-9);
  EXPECT_NEAR(events[0].figures[1].deviation, 0.2, 1e-12);
}

// The file has twice the displacements with another sign: from 0 to -30 um.
TEST(EventSides, AreSaidToBeBeyondARecordFromItsLeastDisplacementOn) {
  const std::string text =
      event_fit("event = \"jump\"\ndisplacement = { value = \"-40 um\", deviation = \"0.2 um\" }\n");
  const TemporaryCase directory(
      replaced(text, "{ column = \"displacement_m\" }", "{ column = \"displacement_m\", factor = -0.5 }"));
  CsvTable rows = broken_bar().rows;
  for (double& u : rows.columns[0]) u *= -2.0;
  write_csv(directory.path() / "data.csv", rows);
  EXPECT_THAT(run({"check", directory.path().string()}).err,
              HasSubstr("\"one\" was recorded between -30 um and 0 m in its file, before the factor"));
}

// The second one of those that fall by a third is not that of those that fall by a tenth.
TEST(EventSides, AreOthersWithAnotherLeastFall) {
  const std::string jump = "event = \"jump\"\nnumber = 1\nleast_fall = ";
  const TemporaryCase directory(
      event_fit(jump + "0.3\ndisplacement = { value = \"11 um\", deviation = \"1 um\" }\n[[experiment.events]]\n" +
                jump + "0.1\ndisplacement = { value = \"12 um\", deviation = \"1 um\" }\n"));
  broken_bar().write(directory);
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

MeasuredEvent jump_known_by(double deviation) {
  return {.number = 2,
          .place = 9e-6,
          .figures = {{.figure = EventFigure::displacement, .value = 9e-6, .deviation = deviation}}};
}

TEST(EventSides, AreWarnedOfWhereTheirLoadStepsAreOthers) {
  EXPECT_EQ(warning_of_steps(jump_known_by(1e-7), jump_known_by(1.04e-7), "one"), std::nullopt);
  const auto warning = warning_of_steps(jump_known_by(1e-7), jump_known_by(2e-7), "one");
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, HasSubstr("jump 2 of one counts with a standard deviation of 100 nm"));
  EXPECT_THAT(*warning, HasSubstr("it would be 200 nm"));
  EXPECT_THAT(*warning, HasSubstr("loading.maximum_increment"));
}

// A caller that has not asked before.
TEST(EventSides, InNoStageAreRefusedByTheFitItself) {
  const TemporaryCase directory(event_fit() + "[[fit.stages]]\nname = \"all\"\nbetween = [\"0 um\", \"8 um\"]\n");
  broken_bar().write(directory);
  const CaseFile file = open_case(directory.path());
  const auto experiment = read_experiment(file.config.root(), file.directory);
  const std::vector<MeasuredEvent> events = events_in_records(experiment->events, experiment->specimens);
  const auto settings = read_curve_fit(file);
  std::ostringstream said;
  Log log(said, said, false, true);
  Session session{.results = directory.results(), .max_steps = {}, .until = {}, .version = "0", .log = log};
  const MeasuredFields none;
  const CurveFitJob job{.file = file,
                        .settings = *settings,
                        .specimens = experiment->specimens,
                        .events = events,
                        .fields = none,
                        .straight_from = 0.0,
                        .straight_to = 1e-6,
                        .set_ups = {},
                        .read_curve = {},
                        .laws = {},
                        .other_laws = {},
                        .name = "",
                        .hash = "",
                        .title = ""};
  EXPECT_THROW(fit_curve(job, session), InputError);
}

FittedEvent event_of(const std::string& specimen, const SetUp& set_up) {
  return {.name = "jump 1",
          .specimen = specimen,
          .is_there = true,
          .set_up = set_up,
          .figures = {{.name = "displacement", .unit = "m", .measured = 9e-6, .deviation = 1e-6, .computed = 8e-6},
                      {.name = "force_before", .unit = "N", .computed = 3.0},
                      {.name = "force_after", .unit = "N", .computed = 2.0}}};
}

// Recorded 1 um and 1 N off, with 1 um/N of the machine: at 3 and 2 N of the record the specimen has 2 and 1 N.
TEST(EventSides, AreMarkedOfAllSpecimensAsTheirCurves) {
  const TemporaryCase directory(bar_case());
  CsvTable curves;
  for (const char* name : {"displacement_m", "measured_force_N", "first_force_N", "model_force_N"})
    curves.add(name, {0.0, std::string(name) == "displacement_m" ? 1e-5 : 5.0});
  write_csv(directory.path() / "fit_curve.csv", curves);
  const ExperimentMisfit::Absolute misfit{.rms = 1.0, .rms_measured = 2.0, .quantity = "force", .unit = "N"};
  FitReport report;
  for (const char* name : {"one", "two"})
    report.experiments.push_back(experiment_misfit(name, 2, misfit, "fit_curve.csv"));
  report.events = {event_of("one", {}), event_of("two", {.offset = 1e-6, .force_offset = 1.0, .compliance = 1e-6})};
  const auto rows = fit_on_page(report, directory.path());
  const Chart& chart = std::get<Chart>(rows.back().blocks.front());
  const Series& measured = *std::ranges::find(chart.series, "events, measured", &Series::label);
  ASSERT_EQ(measured.x.size(), 5u);
  EXPECT_THAT((std::vector{measured.x[0], measured.x[1], measured.x[3], measured.x[4]}),
              ElementsAre(DoubleNear(9.0, 1e-9), DoubleNear(9.0, 1e-9), DoubleNear(6.0, 1e-9), DoubleNear(7.0, 1e-9)));
  EXPECT_THAT((std::vector{measured.y[0], measured.y[1], measured.y[3], measured.y[4]}), ElementsAre(3, 2, 2, 1));
}

}  // namespace
}  // namespace pfdm::this_file
