// The page in the browser that pfdm report makes: its numbers are those of the results, and a browser shows it.

#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/text_file.h"
#include "tests/cases/endochronic_case.h"
#include "tests/cases/page_data.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* hostile = "</script><script>alert('x')</script> \\\"µ\\\" & <b>";

nlohmann::json figure(const nlohmann::json& data, const std::string& label) {
  for (const auto& one : data["figures"])
    if (one["label"].get<std::string>().starts_with(label)) return one;
  throw std::runtime_error("the page has no figure \"" + label + "\"");
}

/// Runs the case and makes its page.
std::string page_of(const TemporaryCase& directory) {
  for (const char* command : {"run", "report"}) {
    const Outcome outcome = run({command, directory.path().string()});
    if (outcome.status != 0) throw std::runtime_error(outcome.err);
  }
  return read_file(directory.results() / "report" / "index.html");
}

TEST(Browser, ReportEndsWithThePathOfThePage) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"report", directory.path().string()});
  EXPECT_THAT(outcome.out, EndsWith((directory.results() / "report" / "index.html").string() + "\n"));
}

TEST(Browser, PageOfAFractureHasTheFiguresOfTheSummary) {
  const TemporaryCase directory(bar_case() + crack_plane());
  const std::string html = page_of(directory);
  EXPECT_LT(html.size(), 5000000u);
  const auto data = data_of_page(html);
  const auto summary = read_summary(directory.results() / summary_file);
  const double peak = summary->number("peak_force_N"), at = summary->number("displacement_at_peak_m");
  EXPECT_EQ(figure(data, "Greatest force")["value"], fmt::format("{:.4g} N", peak));
  EXPECT_THAT(figure(data, "Greatest force")["note"].get<std::string>(), HasSubstr(fmt::format("{:.4g} mm", 1e3 * at)));
  EXPECT_THAT(data["headline"][0].get<std::string>(), HasSubstr(fmt::format("{:.4g} N", peak)));
  EXPECT_EQ(figure(data, "Run")["value"], "complete");
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  const auto series = block_of_page(data, "Force against displacement")["series"].back();
  ASSERT_EQ(series["y"].size(), curve.n_rows());
  EXPECT_EQ(series["of_steps"], true);
  for (std::size_t i = 0; i < curve.n_rows(); ++i) {
    const double force = curve.column("force_x_N")[i];
    EXPECT_NEAR(series["y"][i].get<double>(), force, 1e-6 * std::abs(force));
  }
  EXPECT_EQ(data["steps"].size(), curve.n_rows());
  EXPECT_EQ(data["command"], fmt::format("pfdm run {}", directory.path().string()));
  EXPECT_THAT(data["case_text"].get<std::string>(), HasSubstr("kind = \"fracture\""));
  const auto body = data["body"];
  EXPECT_EQ(body["frames"].back(), curve.n_rows() - 1);
  EXPECT_EQ(body["flat_axis"], 2);
  EXPECT_EQ(body["fields"][0]["name"], "damage");
  const double moved = body["displacement"][0]["to"];
  EXPECT_NEAR(moved, curve.column("displacement_m").back(), 1e-7 * moved);  // single precision in the file
}

TEST(Browser, ShowsWhatACaseSaysAsText) {
  const TemporaryCase directory(replaced(bar_case(), "a bar", hostile));
  const std::string html = page_of(directory);
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(data_of_page(html)["title"].get<std::string>(),
              HasSubstr("</script><script>alert('x')</script> \"µ\" & <b>"));
}

TEST(Browser, NamesKeysOffTheirDefaultsAndRegionsAsTheyAreGiven) {
  std::string text = replaced(bar_case(), "name = \"weak\"", "name = \"we<ak>&\"");
  text = replaced(text, "\"bar\", \"weak\"", "\"bar\", \"we<ak>&\"");
  const TemporaryCase directory(replaced(text, "[regions.weak]", "[regions.\"we<ak>&\"]"));
  const auto data = data_of_page(page_of(directory));
  std::map<std::string, std::string> value, otherwise;
  for (const auto& row : data["keys"]) {
    value[row[0]] = row[1];
    otherwise[row[0]] = row[2];
  }
  EXPECT_EQ(value["loading.initial_increment"], "0.1");
  EXPECT_EQ(otherwise["loading.initial_increment"], "0.05");
  EXPECT_EQ(value["output.frames_at"], "[\"0.006 mm\"]");
  EXPECT_EQ(value.count("materials.concrete.young_modulus"), 0u);  // required
  EXPECT_EQ(data["body"]["regions"], (std::vector<std::string>{"bar", "we<ak>&"}));
}

TEST(Browser, PageOfAMaterialPointHasItsCurves) {
  const TemporaryCase directory(tension_case());
  const auto data = data_of_page(page_of(directory));
  EXPECT_TRUE(data["body"].is_null());
  EXPECT_GE(data["blocks"].size(), 2u);
  EXPECT_THAT(data["headline"][0].get<std::string>(), testing::MatchesRegex("Stress xx from .* to .*, von Mises .*"));
  EXPECT_THAT(data["headline"][1].get<std::string>(), HasSubstr("J/m³ are dissipated."));
  const auto summary = read_summary(directory.results() / summary_file);
  const std::vector<std::string> computed{"computed on", processor_name()};
  EXPECT_EQ(summary->processor, processor_name());
  const auto origin = data["origin"].get<std::vector<std::vector<std::string>>>();
  EXPECT_EQ(std::ranges::count(origin, computed), processor_name().empty() ? 0 : 1);
  EXPECT_THAT(data["title"].get<std::string>(), HasSubstr(":"));
}

/// What a browser does that has loaded the page: it moves the slider and clicks on the curve.
constexpr const char* probe = R"(async () => {
  for (let i = 0; i < 300 && !document.documentElement.dataset.body; ++i) await after(50);
  const pixels = () => document.querySelector(".scene canvas").toDataURL();
  const last = pixels();
  const slider = document.querySelector(".steps input");
  slider.value = 0;
  slider.dispatchEvent(new Event("input"));
  const first = pixels();
  const over = document.querySelector(".u-over");
  const box = over.getBoundingClientRect();
  const at = { clientX: box.left + 0.95 * box.width, clientY: box.bottom - 5, bubbles: true };
  for (const type of ["mousemove", "mousedown", "mouseup"]) over.dispatchEvent(new MouseEvent(type, at));
  await after(200);
  return { body: document.documentElement.dataset.body, slider: first !== last, click: pixels() !== first,
           frame: slider.value };
})";

TEST(Browser, ShowsTheBodyAndLinksItWithTheCurve) {
  const TemporaryCase directory(replaced(bar_case(), "a bar", hostile));
  const auto told_if_there = told_by_browser(directory.path(), page_of(directory), probe);
  if (!told_if_there) GTEST_SKIP() << "chromium is not installed";
  const auto& told = *told_if_there;
  EXPECT_EQ(told["body"], "shown");
  EXPECT_EQ(told["slider"], true);
  EXPECT_EQ(told["click"], true);
  EXPECT_NE(told["frame"], "0");
  EXPECT_TRUE(told["errors"].empty()) << told["errors"];
}

}  // namespace
}  // namespace pfdm::this_file
