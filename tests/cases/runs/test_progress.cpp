#include "cases/program/fracture/run/progress.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pfdm::this_file {
namespace {

const ProgressFigures figures{.reached = "454.3 um, 21.83 N",
                              .event = "lower pole debonded",
                              .share = 0.3,
                              .steps = 26,
                              .about_steps = 37,
                              .iteration = 5,
                              .seconds_left = 3725.0};

TEST(ProgressLine, HasAllWhereThereIsRoom) {
  EXPECT_EQ(progress_line(figures, 120),
            "[=======                 ] 454.3 um, 21.83 N, lower pole debonded; 26 of about 37 steps, iteration 5; "
            "1:02:05 left");
}

TEST(ProgressLine, DropsWhatIsLeastImportant) {
  EXPECT_EQ(progress_line(figures, 79), "454.3 um, 21.83 N, lower pole debonded; 26 of about 37 steps; 1:02:05 left");
  EXPECT_EQ(progress_line(figures, 60), "454.3 um, 21.83 N; 26 of about 37 steps; 1:02:05 left");
  EXPECT_EQ(progress_line(figures, 45), "[===        ] 454.3 um, 21.83 N; 1:02:05 left");
  EXPECT_EQ(progress_line(figures, 20), "454.3 um, 21.83 N");
}

TEST(ProgressLine, SaysWhatIsKnown) {
  ProgressFigures first{.reached = "0 um, 0 N", .event = {}};
  EXPECT_EQ(progress_words(first), "0 um, 0 N; 0 steps; time left unknown");
  first.steps = 1, first.iteration = 3;
  EXPECT_EQ(progress_words(first), "0 um, 0 N; 1 step, iteration 3; time left unknown");
}

TEST(ProgressLine, IsNeverLongerThanTheTerminal) {
  ProgressFigures long_ones = figures;
  long_ones.reached = "0.00012345 m, -123456.7 N", long_ones.steps = 12345, long_ones.iteration = 12345;
  for (int columns = 0; columns < 200; ++columns)
    for (const ProgressFigures& some : {figures, long_ones})
      EXPECT_LE(progress_line(some, columns).size(), static_cast<std::size_t>(columns));
}

TEST(ProgressLine, NamesThePole) {
  const Vector up = Vector::UnitZ();
  EXPECT_EQ(debonded_words({.surface = "i", .polar_from = 2.1, .polar_to = 3.0}, up), "lower pole debonded");
  EXPECT_EQ(debonded_words({.surface = "i", .polar_from = 0.0, .polar_to = 0.6}, up), "upper pole debonded");
  EXPECT_EQ(debonded_words({.surface = "i", .polar_from = 0.0, .polar_to = 0.6}, Vector::UnitX()),
            "pole along the load debonded");
  EXPECT_EQ(debonded_words({.surface = "ring", .polar_from = 1.0, .polar_to = 1.5}, up), "\"ring\" debonded");
  EXPECT_EQ(debonded_words({.surface = "glue"}, up), "\"glue\" debonded");
}

/// What the run says of its steps, and the last line that a terminal shows of its progress.
TEST(RunProgress, SpeaksInTheUnitsOfTheCase) {
  std::ostringstream out;
  Log log(out, out, false, false);
  RunProgress progress(log, 0.0, 1.0,
                       {.units = {.displacement = {.name = "um", .si_unit = "m", .in_si = 1e-6}}, .of_box = {}});
  IterationReport iteration{};
  iteration.iteration = 4, iteration.load = 0.25;
  progress.iterated(iteration);
  StepReport step{};
  step.step = 3, step.load = 0.25, step.damaged_volume = 2.5e-14, step.staggered_iterations = 4;
  progress.step_done(step, 156e-6, 0.0105, "lower pole debonded");
  EXPECT_EQ(progress.figures().reached, "156 um, 10.5 mN");
  EXPECT_EQ(progress.figures().about_steps, 6);  // one step made a quarter of the load
  EXPECT_EQ(out.str(),
            "step    3  load 0.25000  displacement 156 um  force 10.5 mN  max damage 0.0000  damaged 25000 um^3    4 "
            "iterations  0:00 elapsed, 0:00 left\n");
}

/// Of a box with interfaces the mean strain and stress, and the debonded area in place of a damage that nothing has.
TEST(RunProgress, OfABoxSaysStrainAndStress) {
  std::ostringstream out;
  Log log(out, out, false, false);
  RunProgress progress(log, 0.0, 1.0, {.units = {}, .of_box = {{0, 1}}, .damage = false, .debonded_area = true});
  StepReport step{};
  step.step = 12, step.load = 0.5, step.staggered_iterations = 2, step.debonded_area = {2e-7, 1e-7};
  step.means.emplace();
  step.means->strain(0, 1) = 0.0125, step.means->stress(0, 1) = 2.6641e6;
  progress.step_done(step, 1e-6, 0.1, "");
  EXPECT_EQ(progress.figures().reached, "strain_xy 0.0125, stress_xy 2.664 MPa");
  EXPECT_EQ(out.str(),
            "step   12  load 0.50000  strain_xy 0.0125  stress_xy 2.664 MPa  debonded 0.3 mm^2    2 iterations  0:00 "
            "elapsed, time left unknown\n");
}

TEST(ProgressLine, IsCutToTheTerminal) {
  std::ostringstream out;
  Log log(out, out, true, false);
  log.progress(std::string(300, 'x'));
  const auto shown = static_cast<std::size_t>(log.columns());
  EXPECT_EQ(out.str(), fmt::format("\r{:x<{}}\x1b[K", "", shown));
}

/// A run of steps that all take as many iterations of a second each.
TEST(TimeLeft, HoldsWhileAStepIterates) {
  TimeLeft left(0.0, 1.0);
  double elapsed = 0.0;
  for (int step = 1; step <= 10; ++step) {
    for (int iteration = 1; iteration <= 50; ++iteration) {
      elapsed += 1.0;
      left.iterated(iteration, 0.1 * step);
      if (step == 1)
        EXPECT_FALSE(left.seconds(elapsed));
      else
        EXPECT_NEAR(left.seconds(elapsed).value(), 500.0 - elapsed, 1e-6) << step << " " << iteration;
    }
    left.step_done(0.1 * step);
    EXPECT_NEAR(left.seconds(elapsed).value(), 500.0 - elapsed, 1e-6);
  }
}

TEST(TimeLeft, GrowsWithAStepThatTakesMoreThanOthers) {
  TimeLeft left(0.0, 1.0);
  left.iterated(1, 0.1);
  left.step_done(0.1);
  for (int iteration = 1; iteration <= 99; ++iteration) left.iterated(iteration, 0.2);
  // 100 s for 0.2 of the load.
  EXPECT_NEAR(left.seconds(100.0).value(), 400.0, 1e-9);
}

TEST(TimeLeft, CountsStepsThatWereGivenUp) {
  TimeLeft left(0.0, 1.0);
  left.iterated(1, 0.1);
  left.step_done(0.1);
  for (int iteration = 1; iteration <= 18; ++iteration) left.iterated(iteration, 0.3);
  left.iterated(1, 0.2);
  left.step_done(0.2);
  EXPECT_NEAR(left.seconds(20.0).value(), 80.0, 1e-9);
}

TEST(TimeLeft, IsUnknownWhereTheLoadFallsBack) {
  TimeLeft left(0.0, 1.0);
  left.iterated(1, 0.5);
  left.step_done(0.5);
  ASSERT_TRUE(left.seconds(1.0));
  left.iterated(1, 0.4);
  EXPECT_FALSE(left.seconds(2.0));
  left.step_done(0.4);
  EXPECT_FALSE(left.seconds(2.0));
}

}  // namespace
}  // namespace pfdm::this_file
