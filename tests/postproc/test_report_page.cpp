// The page of a report: axes, texts, charts and the two files, all without a display.

#include "physics/error.h"
#include "postproc/page/chart_drawing.h"
#include "postproc/page/chart_ticks.h"
#include "postproc/page/display_unit.h"
#include "postproc/page/lettering.h"
#include "postproc/page/page_drawing.h"
#include "postproc/page/page_text.h"
#include "postproc/page/raster.h"
#include "tests/postproc/recording_paper.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <zlib.h>

#include <array>
#include <cmath>

namespace pfdm::test {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(DisplayUnit, TakesThePrefixThatLeavesFewDigits) {
  EXPECT_EQ(shown(624e-6, "m"), "624\u00a0µm");
  EXPECT_EQ(shown(0.9999999, "N"), "1\u00a0N");
  EXPECT_EQ(shown(-13.456, "N"), "-13.46\u00a0N");
  EXPECT_EQ(shown(70e9, "Pa"), "70\u00a0GPa");
  EXPECT_EQ(shown(0.0, "J"), "0\u00a0J");
  EXPECT_EQ(shown(1.395e-11, "m^3"), "0.01395\u00a0mm³");
  EXPECT_EQ(shown(4.56e-3, "m^2"), "0.00456\u00a0m²");
  EXPECT_EQ(shown(12345.6), "12346");
  EXPECT_EQ(shown(std::nan(""), "N"), "-");
  EXPECT_DOUBLE_EQ(display_unit(3e-4, "m").factor, 1e6);
  EXPECT_DOUBLE_EQ(display_unit(3e-5, "m^2").factor, 1e6);
}

TEST(AxisTicks, AreRoundNumbers) {
  const AxisTicks free = axis_ticks({.title = {}}, 0.0, 624.0, 6);
  EXPECT_THAT(free.labels, ElementsAre("0", "100", "200", "300", "400", "500", "600"));
  EXPECT_EQ(free.from, 0.0);
  EXPECT_GT(free.to, 624.0);
  const AxisTicks fixed = axis_ticks({.title = {}, .from = -0.5, .to = 0.5}, 0.0, 0.0, 5);
  EXPECT_THAT(fixed.labels, ElementsAre("-0.4", "-0.2", "0.0", "0.2", "0.4"));
  EXPECT_EQ(fixed.to, 0.5);
  const AxisTicks level = axis_ticks({.title = {}}, 3.0, 3.0, 4);
  EXPECT_LT(level.from, 3.0);
  EXPECT_GT(level.to, 3.0);
}

TEST(AxisTicks, OfALogarithmCountInDecades) {
  const AxisTicks ticks = axis_ticks({.title = {}, .logarithmic = true}, 1e-3, 1e3, 6);
  EXPECT_DOUBLE_EQ(ticks.from, -3.0);
  EXPECT_DOUBLE_EQ(ticks.to, 3.0);
  std::vector<std::string> labels;
  for (const std::string& label : ticks.labels)
    if (!label.empty()) labels.push_back(label);
  EXPECT_THAT(labels, ElementsAre("1e-3", "0.01", "0.1", "1", "10", "100", "1000"));
  EXPECT_EQ(ticks.labels.size(), labels.size());
  const AxisTicks few = axis_ticks({.title = {}, .logarithmic = true}, 1.0, 100.0, 4);
  EXPECT_EQ(few.labels.size(), 19u);
  EXPECT_EQ(few.labels[1], "2");
  EXPECT_EQ(few.labels[2], "");
  const AxisTicks none = axis_ticks({.title = {}, .logarithmic = true}, INFINITY, -INFINITY, 6);
  EXPECT_LT(none.from, none.to);
}

TEST(Lettering, HasTheWidthsOfHelvetica) {
  EXPECT_NEAR(text_width("M", 1000.0), 833.0, 1.0);
  EXPECT_NEAR(text_width("force", 1000.0), 278.0 + 556.0 + 333.0 + 500.0 + 556.0, 3.0);
  EXPECT_NEAR(text_width("µ°²", 1000.0), 576.0 + 400.0 + 333.0, 3.0);
  EXPECT_GT(text_width("M", 10.0, true), 8.0);
  double area = 0.0;  // of an o, its hole taken off
  for (const auto& polygon : text_outline("o", 1.0, false))
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const PaperPoint& a = polygon[i];
      const PaperPoint& b = polygon[(i + 1) % polygon.size()];
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
  EXPECT_GT(std::abs(area), 0.08);
  EXPECT_LT(std::abs(area), 0.2);
}

int grey_at(const Raster& raster, int x, int y) {
  return raster.pixels()[3 * static_cast<std::size_t>(y * raster.width() + x)];
}

TEST(Raster, PaintsEachPixelByThePartThatIsCovered) {
  Raster raster(4, 4);
  raster.add(std::array<PixelPoint, 4>{{{0.5, 0.0}, {2.0, 0.0}, {2.0, 1.25}, {0.5, 1.25}}});
  raster.paint({});
  EXPECT_EQ(grey_at(raster, 0, 0), 128);
  EXPECT_EQ(grey_at(raster, 1, 0), 0);
  EXPECT_EQ(grey_at(raster, 1, 1), 191);
  EXPECT_EQ(grey_at(raster, 2, 0), 255);
  EXPECT_EQ(grey_at(raster, 1, 2), 255);
}

TEST(Raster, JoinsConvexPiecesAndKeepsHoles) {
  Raster raster(8, 8);
  const std::array<PixelPoint, 4> square{{{1, 1}, {7, 1}, {7, 7}, {1, 7}}}, hole{{{3, 3}, {3, 5}, {5, 5}, {5, 3}}};
  raster.add(square);
  raster.add(hole);
  raster.paint({});
  EXPECT_EQ(grey_at(raster, 2, 2), 0);
  EXPECT_EQ(grey_at(raster, 4, 4), 255);
  Raster joined(8, 8);
  joined.add_convex(square);
  joined.add_convex(hole);
  joined.paint({});
  EXPECT_EQ(grey_at(joined, 4, 4), 0);
}

TEST(Raster, LeavesWhatIsOutsideOfTheWindow) {
  Raster raster(6, 6);
  raster.set_window(2, 2, 4, 4);
  raster.add(std::array<PixelPoint, 4>{{{-10, -10}, {20, -10}, {20, 20}, {-10, 20}}});
  raster.paint({1.0, 0.0, 0.0});
  EXPECT_EQ(grey_at(raster, 3, 3), 255);
  EXPECT_EQ(raster.pixels()[3 * (3 * 6 + 3) + 1], 0);
  EXPECT_EQ(raster.pixels()[3 * (1 * 6 + 3) + 1], 255);
  EXPECT_EQ(raster.pixels()[3 * (3 * 6 + 5) + 1], 255);
}

bool near(const Colour& a, const Colour& b) {
  return std::abs(a.red - b.red) < 0.01 && std::abs(a.green - b.green) < 0.01 && std::abs(a.blue - b.blue) < 0.01;
}

std::vector<std::vector<PaperPoint>> lines_near(const RecordingPaper& paper, int series) {
  std::vector<std::vector<PaperPoint>> lines;
  for (const auto& stroke : paper.strokes)
    if (near(stroke.pen.colour, series_colour(series))) lines.push_back(stroke.line);
  return lines;
}

constexpr Rectangle place{50.0, 80.0, 240.0, 160.0};

Chart line_chart(std::vector<double> x, std::vector<double> y) {
  return {.caption = {},
          .x = {.title = "displacement [µm]"},
          .y = {.title = "force [N]"},
          .series = {{.label = {}, .x = std::move(x), .y = std::move(y), .colour = 2}}};
}

TEST(ChartDrawing, PutsPointsWhereTheAxesSay) {
  // Far from zero, and close together beside their size.
  const double at = 10.76;
  Chart chart = line_chart({at, at + 0.04, at + 0.08}, {1.0, 3.0, 2.0});
  chart.x.from = at;
  chart.x.to = at + 0.08;
  chart.y.from = 1.0;
  chart.y.to = 3.0;
  RecordingPaper paper;
  draw_chart(paper, place, chart);
  const auto lines = lines_near(paper, 2);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_EQ(lines[0].size(), 3u);
  const PaperPoint a = lines[0][0], b = lines[0][1], c = lines[0][2];
  EXPECT_NEAR(b.x() - a.x(), c.x() - b.x(), 1e-3);
  EXPECT_NEAR(c.y() - a.y(), 0.5 * (b.y() - a.y()), 1e-3);
  EXPECT_GT(a.x(), place.left);
  EXPECT_LT(c.x(), place.right());
  EXPECT_GT(c.x() - a.x(), 0.7 * place.width);
  EXPECT_GT(a.y(), place.bottom + 15.0);
  EXPECT_LT(b.y(), place.top());
  EXPECT_GT(b.y() - a.y(), 0.7 * place.height);
}

TEST(ChartDrawing, InterruptsLinesAtWhatIsNoNumber) {
  const double none = std::nan("");
  RecordingPaper paper;
  draw_chart(paper, place, line_chart({0, 1, 2, 3, 4}, {1, 2, none, 4, 5}));
  EXPECT_EQ(lines_near(paper, 2).size(), 2u);
  Chart logarithmic = line_chart({1, 10, 100, 1000}, {1, 2, 3, 4});
  logarithmic.x.logarithmic = true;
  RecordingPaper decades;
  draw_chart(decades, place, logarithmic);
  const auto line = lines_near(decades, 2);
  ASSERT_EQ(line.size(), 1u);
  ASSERT_EQ(line[0].size(), 4u);
  EXPECT_NEAR(line[0][1].x() - line[0][0].x(), line[0][3].x() - line[0][2].x(), 1e-3);
}

TEST(ChartDrawing, FillsBandsAndMarksPoints) {
  Chart chart = line_chart({0, 1, 2}, {0, 1, 2});
  chart.series[0].style = SeriesStyle::points;
  chart.series.push_back(
      {.label = {}, .x = {0, 1, 2}, .y = {0, 0, 0}, .style = SeriesStyle::band, .colour = 3, .upper = {1, 2, 1}});
  RecordingPaper paper;
  draw_chart(paper, place, chart);
  const auto n_fills = [&](int series) {
    return std::ranges::count_if(paper.fills, [&](const auto& f) { return near(f.colour, series_colour(series)); });
  };
  EXPECT_EQ(n_fills(2), 3);
  EXPECT_EQ(n_fills(3), 2);
  EXPECT_TRUE(lines_near(paper, 2).empty());
}

TEST(ChartDrawing, KeepsTextsApartAndWithinTheirPlace) {
  for (const double scale : {1e-7, 1.0, 3.3e6})
    for (const bool logarithmic : {false, true}) {
      Chart chart = line_chart({scale, 4 * scale, 900 * scale}, {-2 * scale, 7 * scale, 5 * scale});
      chart.x.logarithmic = logarithmic;
      RecordingPaper paper;
      draw_chart(paper, place, chart);
      EXPECT_GE(paper.texts.size(), 6u);
      for (std::size_t i = 0; i < paper.texts.size(); ++i) {
        const auto& box = paper.texts[i].box;
        EXPECT_GE(box.min().x(), place.left - 0.5) << paper.texts[i].text;
        EXPECT_GE(box.min().y(), place.bottom - 0.5) << paper.texts[i].text;
        EXPECT_LE(box.max().x(), place.right() + 12.0) << paper.texts[i].text;
        for (std::size_t k = 0; k < i; ++k)
          EXPECT_FALSE(box.intersects(paper.texts[k].box)) << paper.texts[i].text << " over " << paper.texts[k].text;
      }
    }
}

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

/// What the one stream of a PDF holds.
std::string drawing_in(const std::string& pdf) {
  const std::size_t start = pdf.find("stream\n") + 7, end = pdf.find("\nendstream");
  std::string drawing(1 << 22, '\0');
  uLongf n = drawing.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(drawing.data()), &n, reinterpret_cast<const Bytef*>(pdf.data() + start),
                       end - start),
            Z_OK);
  drawing.resize(n);
  return drawing;
}

TEST(PageDrawing, MakesAPdfOfVectorsAndText) {
  const std::string pdf = page_as_pdf(example_page());
  EXPECT_THAT(pdf, StartsWith("%PDF-1.4"));
  EXPECT_THAT(pdf, EndsWith("%%EOF\n"));
  EXPECT_THAT(pdf, HasSubstr("(bead: a \\(test\\))"));
  const std::size_t table = std::stoul(pdf.substr(pdf.find("startxref\n") + 10));
  ASSERT_EQ(pdf.substr(table, 7), "xref\n0 ");
  const int n = std::stoi(pdf.substr(table + 7));
  for (int i = 1; i < n; ++i) {
    const std::size_t entry = pdf.find('\n', table + 5) + 1 + 20 * static_cast<std::size_t>(i);
    const std::string head = std::to_string(i) + " 0 obj\n";
    EXPECT_EQ(pdf.substr(std::stoul(pdf.substr(entry, 10)), head.size()), head);
  }
  const std::string drawing = drawing_in(pdf);
  EXPECT_THAT(drawing, HasSubstr("(force [N]) Tj"));
  EXPECT_THAT(drawing, HasSubstr("(displacement [\xb5m]) Tj"));
  EXPECT_THAT(drawing, HasSubstr("(Gc [J/m\xb2]) Tj"));
  EXPECT_THAT(drawing, HasSubstr("(bead: a \\(test\\)) Tj"));
  EXPECT_EQ(pdf, page_as_pdf(example_page()));
}

TEST(PageDrawing, MakesAPngThatIsNotBlank) {
  const std::string png = page_as_png(example_page(), 50.0);
  EXPECT_EQ(png, page_as_png(example_page(), 50.0));
  vtkNew<vtkPNGReader> reader;
  reader->SetMemoryBuffer(png.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(png.size()));
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  int size[3];
  image->GetDimensions(size);
  EXPECT_EQ(size[0], 413);  // 210 x 297 mm
  EXPECT_EQ(size[1], 585);
  int dark = 0, red = 0;
  for (int y = 0; y < size[1]; ++y)
    for (int x = 0; x < size[0]; ++x) {
      const auto* p = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      dark += p[0] < 128 && p[1] < 128 && p[2] < 128;
      red += p[0] > 90 && p[0] < 115 && p[1] < 10 && p[2] > 15 && p[2] < 40;  // damage 1
    }
  EXPECT_GT(dark, 500);
  EXPECT_GT(red, 1000);
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
}  // namespace pfdm::test
