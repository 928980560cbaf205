#include "postproc/page/page_drawing.h"

#include "postproc/files/atomic_file.h"
#include "postproc/page/chart_drawing.h"
#include "postproc/page/page_text.h"
#include "postproc/page/picture_drawing.h"

#include <algorithm>
#include <numeric>

namespace pfdm {
namespace {

constexpr double sheet_width = 595.3, sheet_height = 841.9;  // A4 [pt]
constexpr double margin = 34.0, gap = 12.0;                  // [pt]

bool is_graphic(const PageBlock& block) {
  return std::holds_alternative<Chart>(block) || std::holds_alternative<Picture>(block);
}

bool is_graphic(const PageRow& row) {
  return std::ranges::any_of(row.blocks, [](const PageBlock& block) { return is_graphic(block); });
}

std::vector<double> widths_of(const PageRow& row, double whole) {
  std::vector<double> widths = row.widths;
  if (widths.size() != row.blocks.size()) widths.assign(row.blocks.size(), 1.0);
  const double free = whole - gap * (static_cast<double>(widths.size()) - 1.0);
  const double sum = std::accumulate(widths.begin(), widths.end(), 0.0);
  for (double& width : widths) width *= free / sum;
  return widths;
}

double height_of_text(const PageBlock& block, double width) {
  if (const auto* table = std::get_if<Table>(&block)) return table_height(*table, width);
  if (const auto* text = std::get_if<TextBlock>(&block)) return text_height(*text, width);
  return 0.0;
}

double height_of_texts(const PageRow& row, double whole_width) {
  const std::vector<double> widths = widths_of(row, whole_width);
  double height = 0.0;
  for (std::size_t i = 0; i < row.blocks.size(); ++i)
    height = std::max(height, height_of_text(row.blocks[i], widths[i]));
  return height;
}

/// Below the title. Texts and tables take what they need; rows with graphics share the rest.
std::vector<double> row_heights(const ReportPage& page, double width, double height) {
  std::vector<double> heights;
  double rest = height - gap * (static_cast<double>(page.rows.size()) - 1.0), shares = 0.0;
  for (const PageRow& row : page.rows) {
    heights.push_back(height_of_texts(row, width));
    if (is_graphic(row))
      shares += row.height;
    else
      rest -= heights.back();
  }
  for (std::size_t i = 0; i < page.rows.size(); ++i)
    if (is_graphic(page.rows[i])) heights[i] = std::max(heights[i], rest * page.rows[i].height / shares);
  return heights;
}

void draw_block(Paper& paper, const Rectangle& place, const PageBlock& block) {
  if (const auto* table = std::get_if<Table>(&block)) return draw_table(paper, place, *table);
  if (const auto* text = std::get_if<TextBlock>(&block)) return draw_text(paper, place, *text);
  if (const auto* picture = std::get_if<Picture>(&block)) return draw_picture(paper, place, *picture);
  const Chart& chart = std::get<Chart>(block);
  draw_chart(paper, below_key(paper, below_caption(paper, place, chart.caption), chart), chart);
}

void draw_row(Paper& paper, const Rectangle& place, const PageRow& row) {
  const std::vector<double> widths = widths_of(row, place.width);
  Rectangle block = place;
  for (std::size_t i = 0; i < row.blocks.size(); ++i) {
    block.width = widths[i];
    draw_block(paper, block, row.blocks[i]);
    block.left += widths[i] + gap;
  }
}

void draw_page(Paper& paper, const ReportPage& page) {
  const Rectangle sheet{margin, margin, sheet_width - 2.0 * margin, sheet_height - 2.0 * margin};
  Rectangle rest = below_title(paper, sheet, page.title, page.subtitle);
  const std::vector<double> heights = row_heights(page, rest.width, rest.height);
  double top = rest.top();
  for (std::size_t i = 0; i < page.rows.size(); ++i) {
    draw_row(paper, {rest.left, top - heights[i], rest.width, heights[i]}, page.rows[i]);
    top -= heights[i] + gap;
  }
}

}  // namespace

std::string page_as_pdf(const ReportPage& page) {
  const auto paper = pdf_paper(sheet_width, sheet_height, page.title);
  draw_page(*paper, page);
  return paper->content();
}

std::string page_as_png(const ReportPage& page, double dots_per_inch) {
  const auto paper = png_paper(sheet_width, sheet_height, dots_per_inch);
  draw_page(*paper, page);
  return paper->content();
}

void write_page(const std::filesystem::path& folder, const ReportPage& page) {
  make_folder(folder);
  write_file(folder / "report.pdf", page_as_pdf(page));
  write_file(folder / "report.png", page_as_png(page));
}

}  // namespace pfdm
