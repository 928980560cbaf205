// Runs side by side: pfdm report A B, and the page of a sweep. Their numbers are those of the results.

#include "cases/program/studies/sweep/compared_runs.h"
#include "cases/program/studies/sweep/merged_charts.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "postproc/page/display_unit.h"
#include "tests/cases/page_data.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double seven_digits = 1e-6;  // that a page has

using Words = std::vector<std::string>;

std::string weaker_case() {
  return replaced(replaced(bar_case(), "a bar", "</script><script>alert('x')</script> \\\"µ\\\" & <b>"),
                  "toughness = \"80 J/m^2\"", "toughness = \"60 J/m^2\"");
}

void run_it(const TemporaryCase& directory) {
  const Outcome outcome = run({"run", directory.path().string()});
  if (outcome.status != 0) throw std::runtime_error(outcome.err);
}

/// Two bars that have run, one above the other's toughness; the page is in `page`.
struct TwoBars {
  TemporaryCase strong{bar_case()}, weak{weaker_case()};
  TwoBars() {
    run_it(strong);
    run_it(weak);
  }
  fs::path page() const { return weak.path() / "a \"page\" <b>"; }
  Words command() const {
    return {"report", strong.path().string(), weak.path().string(), "--output", page().string()};
  }
};

TEST(Comparison, HasTheNumbersOfTheResults) {
  const TwoBars bars;
  const Outcome outcome = run(bars.command());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr((bars.page() / "index.html").string()));
  const auto data = data_of_page(content_of(bars.page() / "index.html"));
  const Words names{bars.strong.path().filename(), bars.weak.path().filename()};

  const auto chart = block_of_page(data, "Force against displacement");
  ASSERT_EQ(chart["series"].size(), 2u);
  EXPECT_EQ(chart["y"]["title"], "force x [N]");
  const TemporaryCase* cases[] = {&bars.strong, &bars.weak};
  const auto figures = block_of_page(data, "Figures")["rows"];
  EXPECT_EQ(figures[0], nlohmann::json({"", names[0], names[1]}));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(chart["series"][k]["label"], names[k]);
    const CsvTable curve = read_csv(cases[k]->results() / "force_displacement.csv");
    ASSERT_EQ(chart["series"][k]["y"].size(), curve.n_rows());
    for (std::size_t i = 0; i < curve.n_rows(); ++i) {
      const double force = curve.column("force_x_N")[i];
      EXPECT_NEAR(chart["series"][k]["y"][i], force, seven_digits * std::abs(force));
      EXPECT_NEAR(chart["series"][k]["x"][i], 1e6 * curve.column("displacement_m")[i], 1e-5);
    }
    const auto summary = read_summary(cases[k]->results() / summary_file);
    const std::pair<std::string, double> due[] = {
        {"peak force [N]", summary->number("peak_force_N")},
        {"external work [µJ]", 1e6 * summary->number("external_work_J")},
        {"initial stiffness [MN/m]", 1e-6 * summary->number("initial_stiffness_N_per_m")}};
    for (const auto& [name, value] : due) {
      const auto row = std::ranges::find_if(figures, [&](const auto& r) { return r[0] == name; });
      ASSERT_NE(row, figures.end()) << name;
      EXPECT_EQ((*row)[k + 1], shown(value));
    }
  }
  EXPECT_EQ(block_of_page(data, "Keys that differ")["rows"],
            nlohmann::json({{"key", names[0], names[1]}, {"regions.weak.toughness", "80 J/m^2", "60 J/m^2"}}));
}

TEST(Comparison, HasBothBodiesInStep) {
  const TwoBars bars;
  ASSERT_EQ(run(bars.command()).status, 0);
  const auto data = data_of_page(content_of(bars.page() / "index.html"));
  ASSERT_EQ(data["bodies"].size(), 2u);
  EXPECT_EQ(data["bodies_axis"]["unit"], "µm");
  for (const auto& body : data["bodies"]) {
    ASSERT_EQ(body["at"].size(), body["body"]["frames"].size());
    EXPECT_NEAR(body["at"].back(), 15.0, 1e-4);  // the end of the load, 0.015 mm
  }
  EXPECT_NE(data["bodies"][0]["body"]["shape"]["id"], data["bodies"][1]["body"]["shape"]["id"]);
}

TEST(Comparison, ShowsWhatCasesAndFoldersSayAsText) {
  const TwoBars bars;
  ASSERT_EQ(run(bars.command()).status, 0);
  const std::string html = content_of(bars.page() / "index.html");
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(data_of_page(html)["command"].get<std::string>(), HasSubstr("<b>"));
  EXPECT_THAT(data_of_page(html)["origin"].dump(), HasSubstr("alert('x')"));
}

TEST(Comparison, TakesTheCaseAsItRan) {
  const TwoBars bars;
  bars.strong.write("case.toml", replaced(bar_case(), "80 J/m^2", "70 J/m^2"));  // changed since
  ASSERT_EQ(run(bars.command()).status, 0);
  const auto data = data_of_page(content_of(bars.page() / "index.html"));
  EXPECT_EQ(block_of_page(data, "Keys that differ")["rows"][1][1], "80 J/m^2");
}

TEST(Comparison, ReplacesOnlyItsOwnPages) {
  const TwoBars bars;
  ASSERT_EQ(run(bars.command()).status, 0);
  EXPECT_EQ(run(bars.command()).status, 0);  // again
  Words command = bars.command();
  for (const fs::path& foreign : {bars.strong.results(), bars.strong.path(), bars.strong.path() / "case.toml"}) {
    command.back() = foreign.string();
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 2) << foreign;
    EXPECT_THAT(outcome.err, HasSubstr("choose another"));
    EXPECT_FALSE(fs::exists(foreign / "index.html"));
  }
}

TEST(Comparison, SaysWhatIsWrong) {
  const TwoBars bars;
  const TemporaryCase fresh(bar_case());
  const std::string a = bars.strong.path().string(), out = (fresh.path() / "page").string();
  const std::pair<Words, std::string> wrong[] = {
      {{"report", a, bars.strong.results().string(), "-o", out}, "are the same run"},
      {{"report", a, a + "x", "-o", out}, "there is no such case or folder of results"},
      {{"report", a, fresh.path().string(), "-o", out}, "there are no results; pfdm run "},
      {{"report", a, bars.weak.path().string(), "--set", "title=x", "-o", out}, "--set is for one case"},
  };
  for (const auto& [command, message] : wrong) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
    EXPECT_FALSE(fs::exists(out));
  }
}

std::string swept_case() {
  return weaker_case() + R"(
[sweep]
method = "grid"
[[sweep.parameters]]
key = "regions.weak.toughness"
values = ["60 J/m^2", "80 J/m^2"]
[[sweep.parameters]]
key = "fracture.length"
values = ["3 mm", "4 mm", "5 mm"]
)";
}

TEST(Comparison, PageOfASweepHasItsTableAndCurves) {
  const TemporaryCase sweep(swept_case());
  ASSERT_EQ(run({"sweep", sweep.path().string()}).status, 0);
  ASSERT_EQ(run({"report", sweep.path().string()}).status, 0);
  const std::string html = content_of(sweep.results() / "report" / "index.html");
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  const auto runs = data_of_page(html)["runs"];
  EXPECT_EQ(data_of_page(html)["command"], fmt::format("pfdm sweep {}", sweep.path().string()));
  const CsvTable table = read_csv(sweep.results() / "sweep.csv", {.has_gaps = true});
  ASSERT_EQ(runs["labels"].size(), 6u);
  EXPECT_EQ(runs["labels"][0], "weak.toughness=60J_m2,length=3mm");
  EXPECT_EQ(runs["columns"][1]["words"], "fracture.length");
  EXPECT_EQ(runs["columns"][1]["is_key"], true);
  EXPECT_EQ(runs["columns"][1]["values"], nlohmann::json({3, 4, 5, 3, 4, 5}));  // mm
  const auto peak = std::ranges::find_if(runs["columns"], [](const auto& c) { return c["words"] == "peak force"; });
  ASSERT_NE(peak, runs["columns"].end());
  for (std::size_t i = 0; i < 6; ++i) {
    const double due = table.column("peak_force_N")[i];
    EXPECT_NEAR((*peak)["values"][i], due, seven_digits * due);
    double most = 0.0;
    for (const double y : runs["curves"][i]["y"]) most = std::max(most, y);
    EXPECT_NEAR(most, due, seven_digits * due);
  }
  // A run of it beside another one: what both have alike is not in their names.
  const fs::path by_value = sweep.results() / "runs_by_value";
  EXPECT_THAT(short_names({(by_value / "weak.toughness=60J_m2,length=3mm").string(),
                           (by_value / "weak.toughness=60J_m2,length=5mm").string()}),
              ElementsAre("length=3mm", "length=5mm"));
  EXPECT_EQ(run({"report", sweep.path().string(), (by_value / "weak.toughness=60J_m2,length=3mm").string(), "-o",
                 (sweep.path() / "page").string()})
                .status,
            2);
}

TEST(Comparison, BrowserSortsRunsAndMovesBothBodies) {
  const TwoBars bars;
  ASSERT_EQ(run(bars.command()).status, 0);
  const auto moved = told_by_browser(bars.weak.path(), content_of(bars.page() / "index.html"), R"(async () => {
    for (let i = 0; i < 300 && !document.documentElement.dataset.body; ++i) await after(50);
    const pixels = () => [...document.querySelectorAll(".scene canvas")].map((c) => c.toDataURL());
    const last = pixels();
    const slider = document.querySelector(".bodies input[type=range]");
    slider.value = 0;
    slider.dispatchEvent(new Event("input"));
    const first = pixels();
    return { n: first.length, moved: first.every((p, k) => p !== last[k]), words: [...document.querySelectorAll(".side .state")].map((e) => e.textContent) };
  })");
  if (!moved) GTEST_SKIP() << "chromium is not installed";
  EXPECT_EQ((*moved)["n"], 2);
  EXPECT_EQ((*moved)["moved"], true);
  EXPECT_THAT((*moved)["words"][1].get<std::string>(), HasSubstr("displacement 0.006 mm"));
  EXPECT_TRUE((*moved)["errors"].empty()) << (*moved)["errors"];

  const TemporaryCase sweep(swept_case());
  ASSERT_EQ(run({"sweep", sweep.path().string()}).status, 0);
  ASSERT_EQ(run({"report", sweep.path().string()}).status, 0);
  const auto sorted =
      told_by_browser(sweep.path(), content_of(sweep.results() / "report" / "index.html"), R"(async () => {
    await after(500);
    const heads = [...document.querySelectorAll(".runs th button")];
    const column = () => [...document.querySelectorAll(".runs tbody tr")].map((r) => r.children[2].textContent);
    heads[2].click();
    const rising = column();
    heads[2].click();
    return { rising, falling: column(), small: document.querySelectorAll(".small figure").length,
             lines: document.querySelectorAll(".parallel .run").length, charts: document.querySelectorAll(".u-over").length };
  })");
  EXPECT_EQ((*sorted)["rising"], nlohmann::json({"3", "3", "4", "4", "5", "5"}));
  EXPECT_EQ((*sorted)["falling"], nlohmann::json({"5", "5", "4", "4", "3", "3"}));
  EXPECT_EQ((*sorted)["small"], 6);
  EXPECT_EQ((*sorted)["lines"], 6);
  EXPECT_EQ((*sorted)["charts"], 1);
  EXPECT_TRUE((*sorted)["errors"].empty()) << (*sorted)["errors"];
}

ReportPage page_with(std::vector<Chart> charts) {
  ReportPage page{.title = {}, .subtitle = {}, .rows = {PageRow{.blocks = {}}}};
  for (Chart& chart : charts) page.rows[0].blocks.emplace_back(std::move(chart));
  return page;
}

Chart force_chart(const std::string& unit, double force) {
  return {.caption = "F",
          .x = {.title = "u of top [µm]"},
          .y = {.title = "F [" + unit + "]"},
          .series = {{.label = "computed", .x = {0.0, 1.0}, .y = {0.0, force}, .of_steps = true},
                     {.label = "measured", .x = {0.0, 1.0}, .y = {0.0, 7.0}}}};
}

TEST(Comparison, BringsCurvesIntoOneUnit) {
  Chart newtons = force_chart("N", 2.0), millinewtons = force_chart("mN", 300.0);
  millinewtons.x.title = "u of bottom [mm]";
  millinewtons.series.pop_back();
  const ReportPage a = page_with({newtons}), b = page_with({millinewtons}), c = page_with({force_chart("MPa", 1.0)});
  const auto charts = merged_charts({{"a", &a}, {"b", &b}, {"c", &c}});
  ASSERT_EQ(charts.size(), 2u);  // stress is no force
  const Chart& merged = std::get<Chart>(charts[0]);
  EXPECT_EQ(merged.y.title, "F [N]");
  EXPECT_EQ(merged.x.title, "u [mm]");
  ASSERT_EQ(merged.series.size(), 3u);
  EXPECT_EQ(merged.series[0].label, "measured");
  EXPECT_EQ(merged.series[1].label, "a");
  EXPECT_THAT(merged.series[1].x, ElementsAre(0.0, 0.001));
  EXPECT_EQ(merged.series[2].label, "b");
  EXPECT_NEAR(merged.series[2].y[1], 0.3, 1e-15);
  EXPECT_NE(merged.series[1].colour, merged.series[2].colour);
}

TEST(Comparison, SplitsChartsWithSeveralCurvesOfARun) {
  Chart energies{.caption = "Energies", .x = {.title = "t [-]"}, .y = {.title = "E [J]"}, .series = {}};
  for (const char* label : {"work", "elastic"})
    energies.series.push_back({.label = label, .x = {0.0, 1.0}, .y = {0.0, 1.0}, .of_steps = true});
  const ReportPage a = page_with({energies}), b = page_with({energies});
  const auto charts = merged_charts({{"a", &a}, {"b", &b}});
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(std::get<Chart>(charts[1]).caption, "Energies: elastic");
  EXPECT_EQ(std::get<Chart>(charts[1]).series[1].label, "b");
}

TEST(DisplayUnit, KnowsWhatLiesBetweenTwo) {
  EXPECT_DOUBLE_EQ(factor_between("mm", "µm").value(), 1e3);
  EXPECT_DOUBLE_EQ(factor_between("m", "mm").value(), 1e3);
  EXPECT_DOUBLE_EQ(factor_between("µm³", "mm³").value(), 1e-9);
  EXPECT_DOUBLE_EQ(factor_between("GPa", "Pa").value(), 1e9);
  EXPECT_DOUBLE_EQ(factor_between("J/m²", "J/m²").value(), 1.0);
  for (const auto& [a, b] :
       {std::pair("mm", "mm²"), std::pair("N", "Pa"), std::pair("", "m"), std::pair("kN/m", "N/m")})
    EXPECT_FALSE(factor_between(a, b)) << a << " " << b;
}

}  // namespace
}  // namespace pfdm::this_file
