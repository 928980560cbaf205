// The page for the browser: numbers packed and back, texts that stay texts.

#include "postproc/browser/browser_page.h"
#include "postproc/browser/packing.h"
#include "postproc/browser/page_script.h"
#include "tests/postproc/temporary_folder.h"
#include "tests/postproc/unpacked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json data_of(const std::string& html) {
  const std::string mark = "id=\"pfdm-data\">";
  const std::size_t from = html.find(mark) + mark.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(Packing, KeepsNumbersToHalfAStep) {
  constexpr std::size_t rows = 5, n = 997;
  std::vector<std::vector<double>> blocks(rows);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = 0; i < n; ++i)
      blocks[r].push_back(3e-4 * std::sin(0.37 * static_cast<double>(i * (r + 1))) - 1e-5 * static_cast<double>(r));
  const Quantised q = quantised(blocks);
  const double step = (q.to - q.from) / 65535.0;
  const auto back = unpacked_blocks(packed(q), rows, n, q.from, q.to);
  double worst = 0.0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(back[r][i] - blocks[r][i]));
  EXPECT_LE(worst, 0.5000001 * step);
  EXPECT_GT(worst, 0.4 * step);  // 16 bits, and no more
}

TEST(Packing, TakesConstantsAndWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Quantised q = quantised({{nan, 2.0, 4.0}, {4.0, nan, 2.0}});
  const auto back = unpacked_blocks(packed(q), 2, 3, q.from, q.to);
  EXPECT_EQ(back[0], (std::vector<double>{2.0, 2.0, 4.0}));
  EXPECT_EQ(back[1], (std::vector<double>{4.0, 2.0, 2.0}));
  const Quantised same = quantised({{7.0, 7.0}});
  EXPECT_EQ(unpacked_blocks(packed(same), 1, 2, same.from, same.to)[0], (std::vector<double>{7.0, 7.0}));
}

TEST(Packing, WritesBase64AsTheStandardHasIt) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string_view("\xff\xfe\xfd", 3)), "//79");
}

BrowserPage hostile_page() {
  const std::string bad = "</script><script>alert('1')</script> <!-- \"µ\" & \xff";
  BrowserPage page{.report = {.title = bad, .subtitle = bad, .rows = {}},
                   .headline = {bad},
                   .figures = {{.label = bad, .value = bad, .note = bad}},
                   .warnings = {bad},
                   .origin = {{bad, bad}},
                   .command = bad,
                   .case_text = bad,
                   .steps = {bad},
                   .body = std::nullopt};
  page.report.rows.push_back({.blocks = {Table{.caption = bad, .rows = {{bad, bad}}}, TextBlock{bad, {bad}}}});
  return page;
}

TEST(BrowserPage, ShowsTextsAsTextsWhateverTheySay) {
  std::string html = page_as_html(hostile_page());
  const std::size_t script = html.find(page_script());
  ASSERT_NE(script, std::string::npos);
  html.erase(script, page_script().size());
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<!--")));
  const auto data = data_of(html);
  const std::string text = data["title"];
  EXPECT_THAT(text, HasSubstr("</script><script>alert('1')</script> <!-- \"µ\" & "));
  EXPECT_EQ(data["blocks"][0]["rows"][0][1], text);
  EXPECT_THAT(html, HasSubstr("<title>&lt;/script>"));
}

TEST(BrowserPage, NamesNoFileButItself) {
  const TemporaryFolder folder;
  write_browser_page(folder.path(), hostile_page());
  EXPECT_EQ(folder.n_entries(), 1u);
  const std::string html = content_of(folder / "index.html");
  for (const char* link : {"src=", "href=\"http", "@import", "url(http"}) {
    const std::string own = html.substr(html.rfind("<script>\n/*") + 9);
    EXPECT_THAT(html.substr(0, html.size() - own.size()), Not(HasSubstr(link)));
  }
  EXPECT_LT(html.size(), 1500000u);
}

TEST(BrowserPage, HasValuesOfTablesInSignsOfPrint) {
  BrowserPage page{};
  page.report.rows.push_back({.blocks = {Table{.caption = "t", .rows = {{"k^2 of um", "-3 um", "120.2 J/m^2"}}}}});
  EXPECT_EQ(data_of(page_as_html(page))["blocks"][0]["rows"][0],
            (std::vector<std::string>{"k^2 of um", "-3 µm", "120.2 J/m²"}));
  page.report.rows[0].blocks = {Table{.caption = "k", .rows = {{"key", "one"}, {"a", "3 J/m^2"}}, .has_header = true}};
  EXPECT_EQ(data_of(page_as_html(page))["blocks"][0]["rows"][1][1], "3 J/m^2");
}

TEST(BrowserPage, HasTheNumbersOfItsCharts) {
  BrowserPage page{};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  page.report.rows.push_back(
      {.blocks = {
           Chart{.caption = "force",
                 .x = {.title = "u [µm]", .logarithmic = true, .from = 0.1},
                 .y = {.title = "F [N]"},
                 .series = {{.label = "one", .x = {0.1, 1.0 / 3.0}, .y = {nan, 27.080123}, .of_steps = true}}}}});
  const auto chart = data_of(page_as_html(page))["blocks"][0];
  EXPECT_EQ(chart["kind"], "chart");
  EXPECT_EQ(chart["x"]["from"], 0.1);
  EXPECT_EQ(chart["x"]["logarithmic"], true);
  EXPECT_NEAR(chart["series"][0]["x"][1].get<double>(), 1.0 / 3.0, 1e-7);
  EXPECT_TRUE(chart["series"][0]["y"][0].is_null());
  EXPECT_EQ(chart["series"][0]["y"][1], 27.08012);
  EXPECT_EQ(chart["series"][0]["of_steps"], true);
}

TEST(BrowserPage, WritesUnitsAsPrintHasThem) {
  EXPECT_EQ(in_print("between 154.6 and 157.1 um, at 33 degrees, 412 J/m^2, 2 mm^3"),
            "between 154.6 and 157.1 µm, at 33°, 412 J/m², 2 mm³");
  EXPECT_EQ(in_print("at (1, 2, 3) um, uniform, sum, N/um, 3 us, one of us, 7 um."),
            "at (1, 2, 3) µm, uniform, sum, N/µm, 3 µs, one of us, 7 µm.");
}

}  // namespace
}  // namespace pfdm::test::this_file
