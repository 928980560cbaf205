// The page of a report: axes, texts, charts and the two files, all without a display.

#include "physics/error.h"
#include "postproc/page/page_drawing.h"
#include "postproc/page/page_text.h"
#include "tests/postproc/pixels.h"
#include "tests/postproc/recording_paper.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poppler-document.h>
#include <poppler-image.h>
#include <poppler-page-renderer.h>
#include <poppler-page.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace pfdm::test::this_file {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(PageText, BreaksLongCellsAndTellsTheHeight) {
  const std::string words = "damage 7.91, driving energy 4.29, moduli and preconditioner 2.19, momentum 20";
  const Table table{.caption = "Run", .rows = {{"CPU by stage [s]", words}, {"memory", "77 MB"}}};
  const Rectangle column{40.0, 100.0, 180.0, 200.0};
  RecordingPaper paper;
  draw_table(paper, column, table);
  double lowest = 1e9;
  std::string joined;
  for (const auto& text : paper.texts) {
    EXPECT_LE(text.box.max().x(), column.right() + 0.5) << text.text;
    lowest = std::min(lowest, text.box.min().y());
    joined += text.text + " ";
  }
  EXPECT_THAT(joined, HasSubstr("momentum 20"));
  EXPECT_GT(paper.texts.size(), 5u);
  EXPECT_NEAR(column.top() - lowest, table_height(table, column.width), 6.0);
  EXPECT_LT(table_height(table, 500.0), table_height(table, 180.0));
}

ReportPage example_page() {
  Picture picture{.caption = "Damage, plane xz",
                  .x_title = "x [mm]",
                  .y_title = "z [mm]",
                  .value_title = "damage d [-]",
                  .cells = {},
                  .lines = {}};
  for (int i = 0; i < 4; ++i) {
    const double x = i;
    picture.cells.push_back({{{x, 0.0}, {x + 1.0, 0.0}, {x + 1.0, 2.0}, {x, 2.0}}, i / 3.0});
  }
  picture.lines.push_back({{1.0, 0.0}, {1.0, 2.0}});
  return {
      .title = "bead: a (test)",
      .subtitle = "pfdm, complete",
      .rows = {{.blocks = {Table{
                    .caption = "Materials", .rows = {{"region", "Gc [J/m²]"}, {"matrix", "400"}}, .has_header = true}}},
               {.blocks = {picture, line_chart({0, 1, 2}, {0, 2, 1})}},
               {.blocks = {TextBlock{.caption = "Warnings", .lines = {"σ is not in Latin 1"}}}}}};
}

std::unique_ptr<poppler::document> opened(const std::string& pdf) {
  poppler::byte_array bytes(pdf.begin(), pdf.end());
  return std::unique_ptr<poppler::document>(poppler::document::load_from_data(&bytes));
}

TEST(PageDrawing, MakesAPdfOfVectorsAndText) {
  const std::string pdf = page_as_pdf(example_page());
  EXPECT_THAT(pdf, StartsWith("%PDF-1."));
  EXPECT_THAT(pdf, EndsWith("%%EOF\n"));
  const auto document = opened(pdf);
  ASSERT_EQ(document->pages(), 1);
  const std::unique_ptr<poppler::page> page(document->create_page(0));
  const poppler::byte_array bytes = page->text().to_utf8();
  const std::string text(bytes.begin(), bytes.end());
  for (const char* part :
       {"force [N]", "displacement [µm]", "Gc [J/m²]", "bead: a (test)", "σ is not in Latin 1", "damage d [-]"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(pdf.find("/Subtype /Image"), std::string::npos);
  EXPECT_EQ(pdf, page_as_pdf(example_page()));
}

TEST(PageDrawing, MakesAPngThatIsNotBlank) {
  const std::string png = page_as_png(example_page(), 50.0);
  EXPECT_EQ(png, page_as_png(example_page(), 50.0));
  const Pixels pixels = read_png(png);
  EXPECT_EQ(pixels.width, 413);  // 210 x 297 mm
  EXPECT_EQ(pixels.height, 585);
  int dark = 0, red = 0;
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const unsigned char* p = pixels.at(x, y);
      dark += p[0] < 128 && p[1] < 128 && p[2] < 128;
      red += p[0] > 90 && p[0] < 115 && p[1] < 10 && p[2] > 15 && p[2] < 40;  // damage 1
    }
  EXPECT_GT(dark, 500);
  EXPECT_GT(red, 1000);
}

/// Poppler's picture of the PDF is the PNG, but for the shades of edges.
TEST(PageDrawing, ShowsTheSameInBothFiles) {
  constexpr double resolution = 150.0;
  const Pixels png = read_png(page_as_png(example_page(), resolution));
  poppler::page_renderer renderer;
  renderer.set_render_hints(poppler::page_renderer::antialiasing | poppler::page_renderer::text_antialiasing);
  const auto document = opened(page_as_pdf(example_page()));
  const std::unique_ptr<poppler::page> page(document->create_page(0));
  poppler::image pdf = renderer.render_page(page.get(), resolution, resolution);
  ASSERT_EQ(pdf.format(), poppler::image::format_argb32);
  ASSERT_NEAR(pdf.width(), png.width, 1);
  ASSERT_NEAR(pdf.height(), png.height, 1);
  double ink = 0.0, difference = 0.0;
  for (int y = 0; y < std::min(pdf.height(), png.height); ++y)
    for (int x = 0; x < std::min(pdf.width(), png.width); ++x) {
      const auto* p = reinterpret_cast<const unsigned char*>(pdf.const_data()) + y * pdf.bytes_per_row() + 4 * x;
      const int of_pdf = p[2] + p[1] + p[0], of_png = png.at(x, y)[0] + png.at(x, y)[1] + png.at(x, y)[2];
      ink += 765 - of_png;
      difference += std::abs(of_pdf - of_png);
    }
  EXPECT_LT(difference, 0.2 * ink);  // by a shift of one pixel it would be 0.32
}

TEST(PageDrawing, WritesBothFiles) {
  const TemporaryFolder folder;
  write_page(folder / "report", example_page());
  EXPECT_THAT(content_of(folder / "report" / "report.pdf"), StartsWith("%PDF"));
  EXPECT_THAT(content_of(folder / "report" / "report.png"), StartsWith("\x89PNG"));
  const TemporaryFolder other;
  put(other / "report", "a file in the way");
  EXPECT_THAT(message_of<ComputationError>([&] { write_page(other / "report", example_page()); }), HasSubstr("report"));
}

}  // namespace
}  // namespace pfdm::test::this_file
