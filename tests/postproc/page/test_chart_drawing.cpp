// Charts and pictures of a page as they are drawn: axes, lines, bands, texts, all on a recording paper.

#include "postproc/page/chart_drawing.h"
#include "postproc/page/chart_ticks.h"
#include "postproc/page/display_unit.h"
#include "postproc/page/picture_drawing.h"
#include "tests/postproc/recording_paper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace pfdm::test::this_file {
namespace {

using ::testing::ElementsAre;
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
  for (const double beyond : {3.0, 3.0 + 1e-15}) {  // level, but for rounding
    const AxisTicks level = axis_ticks({.title = {}}, 3.0, beyond, 4);
    EXPECT_LT(level.from, 2.0);
    EXPECT_GT(level.to, 4.0);
    EXPECT_LT(level.labels.size(), 10u);
  }
  const AxisTicks near = axis_ticks({.title = {}}, 1234567.0, 1234568.0, 5);
  EXPECT_THAT(near.labels, ElementsAre("1234567", "1234567.2", "1234567.4", "1234567.6", "1234567.8", "1234568"));
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
  const auto dots = lines_near(paper, 2);
  ASSERT_EQ(dots.size(), 3u);
  for (const auto& dot : dots) EXPECT_EQ(dot.size(), 1u);
  ASSERT_EQ(paper.fills.size(), 1u);
  EXPECT_TRUE(near(paper.fills[0].colour, series_colour(3)));
  const auto& band = paper.fills[0].polygon;
  ASSERT_EQ(band.size(), 6u);
  const double length = dots[2][0].x() - dots[0][0].x(), height = dots[1][0].y() - dots[0][0].y();
  double area = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
    area += 0.5 * (band[i].x() * band[(i + 1) % 6].y() - band[(i + 1) % 6].x() * band[i].y());
  EXPECT_NEAR(area, 1.5 * height * length, 1e-9 * area);
  EXPECT_NEAR(band[4].y(), dots[2][0].y(), 1e-9);
}

TEST(ChartDrawing, DrawsAxesWhateverTheSeriesHold) {
  const double none = std::nan(""), huge = 1e300;
  const std::vector<std::vector<double>> values{{},           {none, none},  {3.0},
                                                {-2.0, -1.0}, {-huge, huge}, {1.0, 1.0 + 4e-16}};
  for (const std::vector<double>& y : values)
    for (const bool logarithmic : {false, true})
      for (const SeriesStyle style : {SeriesStyle::line, SeriesStyle::line_with_points, SeriesStyle::band}) {
        Chart chart = line_chart(y, y);
        chart.series[0].style = style;
        chart.series[0].upper = y;
        chart.x.logarithmic = chart.y.logarithmic = logarithmic;
        RecordingPaper paper;
        draw_chart(paper, place, chart);
        EXPECT_GE(paper.texts.size(), 4u);
        for (const auto& stroke : paper.strokes)
          for (const PaperPoint& p : stroke.line) EXPECT_TRUE(p.allFinite());
        EXPECT_LT(paper.strokes.size(), 1500u);
        const auto file = pdf_paper(600.0, 800.0, "");
        draw_chart(*file, place, chart);
        EXPECT_THAT(file->content(), StartsWith("%PDF"));
      }
}

TEST(ChartDrawing, MakesLongTitlesSmaller) {
  Chart chart = line_chart({0, 1}, {0, 1});
  for (ChartAxis* axis : {&chart.x, &chart.y})
    while (axis->title.size() < 300) axis->title += " of the specimen";
  RecordingPaper paper;
  draw_chart(paper, place, chart);
  for (const auto& text : paper.texts) {
    EXPECT_GE(text.box.min().x(), place.left);
    EXPECT_LE(text.box.max().x(), place.right());
    EXPECT_GE(text.box.min().y(), place.bottom - 0.5);
    EXPECT_LE(text.box.max().y(), place.top());
  }
}

TEST(ChartDrawing, KeepsTextsApartAndWithinTheirPlace) {
  for (const double scale : {1e-7, 1.0, 3.3e6, -1.7e300})
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

TEST(PictureDrawing, KeepsTheTextsOfAFlatPictureApart) {
  Picture picture{.caption = "Damage",
                  .x_title = "x [mm]",
                  .y_title = "y [mm]",
                  .value_title = "damage d [-]",
                  .cells = {},
                  .lines = {}};
  picture.cells.push_back({{{0.0, -2.5}, {200.0, -2.5}, {200.0, 2.5}, {0.0, 2.5}}, 0.5});
  RecordingPaper paper;
  draw_picture(paper, place, picture);
  EXPECT_GE(paper.texts.size(), 9u);
  for (std::size_t i = 0; i < paper.texts.size(); ++i) {
    EXPECT_LE(paper.texts[i].box.max().y(), place.top() + 0.5) << paper.texts[i].text;
    EXPECT_GE(paper.texts[i].box.sizes().maxCoeff(), 6.0) << paper.texts[i].text;
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(paper.texts[i].box.intersects(paper.texts[k].box))
          << paper.texts[i].text << " over " << paper.texts[k].text;
  }
}

}  // namespace
}  // namespace pfdm::test::this_file
