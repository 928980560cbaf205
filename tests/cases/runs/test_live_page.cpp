// pfdm run --live: when pages are made, and what they hold.

#include "cases/program/fracture/run/live_page.h"
#include "postproc/curves/curve_csv.h"
#include "tests/cases/endochronic_case.h"
#include "tests/cases/page_data.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Spent {
  double share = 0.0;
  int pages = 0;
};

/// A run of steps of so many seconds, whose pages take `cost` seconds times their number.
Spent spent_by(double seconds_a_step, int steps, double cost) {
  PageTimes times = LivePages::usual_times;
  double now = 0.0, in_pages = 0.0;
  Spent spent;
  for (int k = 0; k < steps; ++k) {
    now += seconds_a_step;
    if (!times.is_due(now)) continue;
    const double took = cost * (1 + 0.01 * spent.pages);  // curves grow
    now += took;
    in_pages += took;
    times.made(now, took);
    ++spent.pages;
  }
  spent.share = in_pages / now;
  return spent;
}

TEST(LivePage, KeepsToItsShareOfTheTime) {
  EXPECT_LT(spent_by(0.1, 6000, 0.005).share, 0.02);
  EXPECT_NEAR(spent_by(0.1, 6000, 0.005).pages, 200, 10);  // ten minutes, every three seconds
  const Spent dear = spent_by(0.1, 6000, 0.5);
  EXPECT_LT(dear.share, 0.02);
  EXPECT_GT(dear.share, 0.01);
  EXPECT_LT(spent_by(40.0, 20, 0.2).share, 0.02);
}

/// A bar that has run, and what its pages need.
struct RunBar {
  TemporaryCase directory{replaced(bar_case(), "a bar", "</script><script>alert('x')</script>")};
  std::ostringstream out, err;
  Log log{out, err, false, true};
  CaseFile file = open_case(directory.path());
  FractureCase fracture = read_fracture_case(file.config.root(), file.directory);
  std::optional<ExperimentSettings> none;
  Session session{.results = directory.results(), .max_steps = {}, .until = {}, .version = "0", .log = log};
  std::vector<CurveRow> rows;
  RunBar() {
    run({"run", directory.path().string()});
    rows = read_curve(directory.results() / curve_file);
  }
  LiveCase live() const {
    return {.fracture = fracture,
            .experiment = none,
            .file = file,
            .title = fracture.title,
            .command = "run it",
            .report = "report it"};
  }
  fs::path page() const { return directory.results() / "report" / "index.html"; }
};

const ProgressFigures some_progress{
    .reached = "9 um, 12 N", .event = {}, .share = 0.6, .steps = 6, .about_steps = 10, .seconds_left = 4.0};

TEST(LivePage, TellsHowFarTheRunIs) {
  RunBar bar;
  LivePages pages(bar.live(), bar.session, PageTimes(1.0, 0.0));
  pages.look(some_progress, std::span(bar.rows).first(6));
  const auto data = data_of_page(content_of(bar.page()));
  EXPECT_EQ(data["live"]["words"], "9 µm, 12 N; 6 of about 10 steps; 0:04 left");
  EXPECT_EQ(data["live"]["share"], 0.6);
  EXPECT_EQ(block_of_page(data, "Force against displacement")["series"][0]["y"].size(), 6u);
  pages.end({"It broke."}, bar.rows);
  const auto last = data_of_page(content_of(bar.page()));
  EXPECT_FALSE(last.contains("live"));
  EXPECT_EQ(last["headline"][0], "It broke.");
  EXPECT_EQ(block_of_page(last, "Force against displacement")["series"][0]["y"].size(), bar.rows.size());
}

TEST(LivePage, BrowserShowsThatItRunsUntilItIsHeld) {
  RunBar bar;
  LivePages pages(bar.live(), bar.session, PageTimes(1.0, 0.0));
  pages.look(some_progress, bar.rows);
  const auto told = told_by_browser(bar.directory.path(), content_of(bar.page()), R"(async () => {
    const [words, button] = ["span", "button"].map((tag) => document.querySelector(`.live ${tag}`));
    button.click();
    await after(6000);
    return { words: words.textContent, button: button.textContent, share: document.querySelector("progress").value };
  })");
  if (!told) GTEST_SKIP() << "chromium is not installed";
  EXPECT_EQ((*told)["words"], "9 µm, 12 N; 6 of about 10 steps; 0:04 left");
  EXPECT_EQ((*told)["button"], "Go on");
  EXPECT_EQ((*told)["share"], 0.6);
  EXPECT_TRUE((*told)["errors"].empty()) << (*told)["errors"];
}

TEST(LivePage, LosesThePageRatherThanTheRun) {
  RunBar bar;
  bar.directory.write("results/report", "a file where the folder should be");
  LivePages pages(bar.live(), bar.session, PageTimes(1.0, 0.0));
  for (int k = 0; k < 3; ++k) pages.look(some_progress, bar.rows);
  ASSERT_EQ(bar.log.warnings().size(), 1u);
  EXPECT_THAT(bar.log.warnings()[0], HasSubstr("the page is not kept up to date any more"));
}

TEST(LivePage, IsLeftByARunAndRefusedWhereNothingIsStepped) {
  const TemporaryCase bar(bar_case());
  const Outcome outcome = run({"run", bar.path().string(), "--live", "--max-steps", "3"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("open in a browser: "));
  const auto data = data_of_page(content_of(bar.results() / "report" / "index.html"));
  EXPECT_THAT(data["headline"][0].get<std::string>(), HasSubstr("The run has ended: stopped by --max-steps"));
  EXPECT_FALSE(data.contains("live"));
  const TemporaryCase point(tension_case());
  const Outcome refused = run({"run", point.path().string(), "--live"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--live: only runs of kind"));
}

}  // namespace
}  // namespace pfdm::this_file
