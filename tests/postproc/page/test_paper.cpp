// The two files that a paper becomes: the PNG is read by VTK, the PDF by Poppler.

#include "physics/error.h"
#include "postproc/page/paper.h"
#include "tests/postproc/pixels.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poppler-document.h>
#include <poppler-page.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

namespace pfdm::test::this_file {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double one_pixel_a_point = 72.0;

TEST(Lettering, HasTheWidthsOfHelvetica) {
  EXPECT_NEAR(text_width("M", 1000.0), 833.0, 1.0);
  EXPECT_NEAR(text_width("force", 1000.0), 278.0 + 556.0 + 333.0 + 500.0 + 556.0, 3.0);
  EXPECT_NEAR(text_width("µ°²", 1000.0), 576.0 + 400.0 + 333.0, 3.0);
  EXPECT_DOUBLE_EQ(text_width("force", 7.5), 7.5e-3 * text_width("force", 1000.0));
  EXPECT_GT(text_width("M", 10.0, true), 8.0);
  EXPECT_NEAR(text_width("µ\xe9\xffσ\xc3", 10.0), text_width("µéÿσÃ", 10.0), 1e-12);  // bytes that are no UTF-8
  EXPECT_EQ(fitting_size("force", 8.0, 100.0), 8.0);
  EXPECT_NEAR(text_width("force", fitting_size("force", 8.0, 10.0)), 10.0, 1e-12);
}

/// In another process: this one may have looked for fonts already.
TEST(Lettering, AsksForItsFont) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const TemporaryFolder folder;
  put(folder / "fonts.conf", "<fontconfig></fontconfig>");
  const auto draw_without_fonts = [&] {
    setenv("FONTCONFIG_FILE", (folder / "fonts.conf").c_str(), 1);
    try {
      text_width("M", 1.0);
    } catch (const ComputationError& error) {
      std::fputs(error.what(), stderr);
      std::exit(3);
    }
    std::exit(0);
  };
  EXPECT_EXIT(draw_without_fonts(), testing::ExitedWithCode(3), "Liberation Sans.*fonts-liberation");
}

TEST(PngPaper, PaintsEachPixelByThePartThatIsCovered) {
  const auto paper = png_paper(8.0, 8.0, one_pixel_a_point);
  paper->stroke(std::vector<PaperPoint>{{2.0, -5.0}, {2.0, 4.0}}, {.colour = {}, .width = 1.0, .dashes = {9.0, 9.0}});
  paper->stroke(std::vector<PaperPoint>{{5.625, -5.0}, {5.625, 20.0}}, {.colour = {}, .width = 1.25});
  const Pixels pixels = read_png(paper->content());
  EXPECT_EQ(pixels.width, 8);
  EXPECT_EQ(pixels.height, 8);
  EXPECT_EQ(pixels.at(0, 6)[0], 255);
  EXPECT_NEAR(pixels.at(1, 6)[0], 128, 1);
  EXPECT_NEAR(pixels.at(2, 6)[0], 128, 1);
  EXPECT_EQ(pixels.at(2, 3)[0], 255);  // beyond the dash
  EXPECT_EQ(pixels.at(5, 6)[0], 0);
  EXPECT_NEAR(pixels.at(6, 6)[0], 191, 1);
}

TEST(PngPaper, MakesADotOfASinglePoint) {
  const auto paper = png_paper(20.0, 20.0, one_pixel_a_point);
  paper->stroke(std::vector<PaperPoint>{{10.0, 10.0}}, {.colour = {}, .width = 10.0});
  const Pixels pixels = read_png(paper->content());
  double area = 0.0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) area += 1.0 - pixels.at(x, y)[0] / 255.0;
  EXPECT_NEAR(area, M_PI * 25.0, 0.5);
}

TEST(PngPaper, KeepsTheHolesOfLetters) {
  const auto paper = png_paper(100.0, 100.0, one_pixel_a_point);
  paper->text("o", {50.0, 50.0}, {.size = 100.0, .alignment = 0.5});
  const Pixels pixels = read_png(paper->content());
  double area = 0.0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) area += 1.0 - pixels.at(x, y)[0] / 255.0;
  EXPECT_GT(area, 0.08 * 100.0 * 100.0);
  EXPECT_LT(area, 0.2 * 100.0 * 100.0);
  EXPECT_EQ(pixels.at(50, 50 - 26)[0], 255);
}

TEST(PngPaper, LeavesWhatIsOutsideOfTheWindow) {
  const auto paper = png_paper(6.0, 6.0, one_pixel_a_point);
  const std::array<PaperPoint, 4> sheet{{{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}}};
  paper->clip(Rectangle{2.0, 1.0, 2.0, 2.0});
  paper->fill(sheet, {1.0, 0.0, 0.0});
  paper->clip(std::nullopt);
  const Pixels pixels = read_png(paper->content());
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) {
      const bool inside = x >= 2 && x < 4 && y >= 3 && y < 5;
      EXPECT_EQ(pixels.at(x, y)[0], 255);
      EXPECT_EQ(pixels.at(x, y)[1], inside ? 0 : 255) << x << " " << y;
    }
}

TEST(PngPaper, LeavesNoGapBetweenPolygons) {
  const auto paper = png_paper(20.0, 20.0, 200.0);
  const PaperPoint centre(9.87, 10.21);
  const auto corner = [&](int i) {
    const double angle = 2.0 * M_PI * i / 16;
    return PaperPoint(centre + 50.0 * PaperPoint(std::cos(angle), std::sin(angle)));
  };
  for (int i = 0; i < 16; ++i) paper->fill(std::array{centre, corner(i), corner(i + 1)}, {});
  const Pixels pixels = read_png(paper->content());
  EXPECT_LT(*std::ranges::max_element(pixels.rgb), 40);
}

std::unique_ptr<poppler::document> opened(std::string pdf) {
  poppler::byte_array bytes(pdf.begin(), pdf.end());
  return std::unique_ptr<poppler::document>(poppler::document::load_from_data(&bytes));
}

std::string as_string(const poppler::ustring& text) {
  const poppler::byte_array bytes = text.to_utf8();
  return {bytes.begin(), bytes.end()};
}

TEST(PdfPaper, HoldsTextsWhereTheyWereWritten) {
  const auto paper = pdf_paper(300.0, 200.0, "texts");
  paper->text("displacement", {100.0, 150.0}, {.size = 10.0});
  paper->text("[µm]", {250.0, 150.0}, {.size = 10.0, .alignment = 1.0});
  paper->text("ψσ°²", {50.0, 100.0}, {.size = 8.0, .bold = true, .angle = 0.5 * M_PI, .alignment = 0.5});
  paper->text("caf\xe9", {200.0, 50.0}, {});
  const auto document = opened(paper->content());
  ASSERT_TRUE(document);
  EXPECT_EQ(document->pages(), 1);
  const std::unique_ptr<poppler::page> page(document->create_page(0));
  EXPECT_EQ(page->page_rect().width(), 300.0);
  EXPECT_EQ(page->page_rect().height(), 200.0);
  std::map<std::string, poppler::rectf> boxes;
  for (const poppler::text_box& box : page->text_list()) boxes.emplace(as_string(box.text()), box.bbox());
  ASSERT_EQ(boxes.size(), 4u);
  constexpr double resolution = 0.05;  // of widths in a PDF, thousandths of the size [pt]
  const poppler::rectf displacement = boxes.at("displacement"), unit = boxes.at("[µm]"), turned = boxes.at("ψσ°²");
  EXPECT_NEAR(displacement.left(), 100.0, resolution);
  EXPECT_NEAR(displacement.width(), text_width("displacement", 10.0), resolution);
  EXPECT_LT(displacement.top(), 50.0 - 7.0);  // from the top
  EXPECT_GT(displacement.bottom(), 50.0);
  EXPECT_NEAR(unit.right(), 250.0, resolution);
  EXPECT_NEAR(0.5 * (turned.top() + turned.bottom()), 100.0, resolution);
  EXPECT_NEAR(turned.height(), text_width("ψσ°²", 8.0, true), resolution);
  EXPECT_LT(turned.left(), 50.0 - 5.0);
  EXPECT_EQ(boxes.count("café"), 1u);
}

TEST(PdfPaper, TellsWhatItIsAndNotWhen) {
  const auto paper = pdf_paper(300.0, 200.0, "bead: a (test), σ");
  paper->text("M", {100.0, 150.0}, {});
  paper->text("M", {100.0, 100.0}, {.bold = true});
  const auto document = opened(paper->content());
  EXPECT_EQ(as_string(document->get_title()), "bead: a (test), σ");
  EXPECT_THAT(document->info_keys(), Not(Contains("CreationDate")));
  std::vector<std::string> fonts;
  for (const poppler::font_info& font : document->fonts()) {
    EXPECT_TRUE(font.is_embedded());
    fonts.push_back(font.name());
  }
  EXPECT_EQ(fonts.size(), 2u);
  EXPECT_THAT(fonts, Contains(HasSubstr("LiberationSans")));
  EXPECT_THAT(fonts, Contains(HasSubstr("LiberationSans-Bold")));
}

}  // namespace
}  // namespace pfdm::test::this_file
