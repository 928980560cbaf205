#include "cases/program/fracture/progress.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pfdm::this_file {
namespace {

constexpr ProgressFigures figures{.load = 0.31234,
                                  .end = 1.0,
                                  .share = 0.3,
                                  .damaged_volume = 1.234e-12,
                                  .step = 123,
                                  .iteration = 45,
                                  .seconds_left = 3725.0};

TEST(ProgressLine, HasAllWhereThereIsRoom) {
  EXPECT_EQ(progress_line(figures, 120),
            "[=======                 ] load 0.3123/1, damaged 1.23e-12 m^3, step 123 iteration 45, 1:02:05 left");
}

TEST(ProgressLine, DropsWhatIsLeastImportant) {
  EXPECT_EQ(progress_line(figures, 79),
            "[=======                 ] load 0.3123/1, step 123 iteration 45, 1:02:05 left");
  EXPECT_EQ(progress_line(figures, 40), "[===       ] load 0.3123/1, 1:02:05 left");
  EXPECT_EQ(progress_line(figures, 20), "load 0.3123/1");
}

TEST(ProgressLine, IsNeverLongerThanTheTerminal) {
  ProgressFigures long_ones = figures;
  long_ones.load = 0.00012345, long_ones.end = 12.75, long_ones.step = 12345, long_ones.iteration = 12345;
  for (int columns = 0; columns < 200; ++columns)
    for (const ProgressFigures& some : {figures, long_ones})
      EXPECT_LE(progress_line(some, columns).size(), static_cast<std::size_t>(columns));
}

TEST(ProgressLine, SaysThatTheTimeLeftIsUnknown) {
  ProgressFigures unknown = figures;
  unknown.seconds_left = std::nullopt;
  EXPECT_NE(progress_line(unknown, 120).find("time left unknown"), std::string::npos);
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
