#include "postproc/page/page_text.h"

#include "postproc/page/chart_drawing.h"

#include <algorithm>
#include <numeric>

namespace pfdm {
namespace {

constexpr double page_title_size = 15.0, subtitle_size = 8.0, caption_size = 8.5, text_size = 7.5;  // [pt]
constexpr double line_height = 10.5, caption_height = 13.0, key_height = 10.0;                      // [pt]
constexpr double column_gap = 10.0;                                                                 // [pt]
constexpr double least_last_column = 0.35;  // of a table's width
constexpr Colour grey{0.35, 0.35, 0.35};

/// Words in as many lines as they take.
std::vector<std::string> broken(const std::string& text, double size, double width) {
  std::vector<std::string> lines(1);
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_width(longer, size) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
    start = end + 1;
  }
  return lines;
}

std::vector<std::string> broken_lines(const TextBlock& text, double width) {
  std::vector<std::string> lines;
  for (const std::string& line : text.lines)
    for (std::string& part : broken(line, text_size, width)) lines.push_back(std::move(part));
  return lines;
}

double caption_of(const std::string& caption) { return caption.empty() ? 0.0 : caption_height; }

/// The last column has what the others leave; all become narrower where it would be too little for a word.
std::vector<double> column_widths(const Table& table, double width) {
  std::vector<double> widths;
  for (const auto& row : table.rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], text_width(row[i], text_size));
  }
  if (widths.empty()) return widths;
  const double free = width - column_gap * (static_cast<double>(widths.size()) - 1.0);
  const double others = std::accumulate(widths.begin(), widths.end() - 1, 0.0);
  const double least = std::min(widths.back(), least_last_column * free);
  widths.back() = std::min(widths.back(), std::max(least, free - others));
  if (others + widths.back() > free)
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) widths[i] *= (free - widths.back()) / others;
  return widths;
}

/// At which all columns but the last fit.
double table_size(const Table& table, const std::vector<double>& widths) {
  double size = text_size;
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i) size = std::min(size, fitting_size(row[i], text_size, widths[i]));
  return size;
}

/// Only the last cell of a row takes more than one line.
std::size_t lines_of(const std::vector<std::string>& row, const std::vector<double>& widths) {
  if (row.size() != widths.size()) return 1;
  return broken(row.back(), text_size, widths.back()).size();
}

void draw_swatch(Paper& paper, const PaperPoint& left, double width, const Series& series) {
  constexpr double half_band = 2.5, line_width = 1.2, dot_width = 2.4;  // [pt]
  const Colour colour = series_colour(series.colour);
  const PaperPoint right = left + PaperPoint(width, 0.0), up(0.0, half_band);
  if (series.style == SeriesStyle::band)
    paper.fill(std::vector<PaperPoint>{left - up, right - up, right + up, left + up}, colour);
  if (has_line(series)) paper.stroke(std::vector{left, right}, series_pen(series, line_width));
  if (has_dots(series)) paper.stroke(std::vector<PaperPoint>{0.5 * (left + right)}, {colour, dot_width});
}

}  // namespace

Rectangle below_title(Paper& paper, const Rectangle& place, const std::string& title, const std::string& subtitle) {
  paper.text(title, {place.left, place.top() - page_title_size},
             {.size = fitting_size(title, page_title_size, place.width, true), .bold = true});
  double y = place.top() - page_title_size - 4.0;
  for (const std::string& line : broken(subtitle, subtitle_size, place.width))
    paper.text(line, {place.left, y -= line_height}, {.size = subtitle_size, .colour = grey});
  y -= 5.0;
  paper.stroke(std::vector<PaperPoint>{{place.left, y}, {place.right(), y}}, {grey, 0.6});
  return {place.left, place.bottom, place.width, y - 8.0 - place.bottom};
}

Rectangle below_caption(Paper& paper, const Rectangle& place, const std::string& caption) {
  if (caption.empty()) return place;
  paper.text(caption, {place.left, place.top() - caption_size},
             {.size = fitting_size(caption, caption_size, place.width, true), .bold = true});
  return {place.left, place.bottom, place.width, place.height - caption_height};
}

Rectangle below_key(Paper& paper, const Rectangle& place, const Chart& chart) {
  constexpr double swatch = 14.0;
  double x = place.left, y = place.top() - 6.5;
  bool any = false;
  for (const Series& series : chart.series) {
    if (series.label.empty()) continue;
    const double size = fitting_size(series.label, text_size, place.width - swatch - 4.0);
    const double width = swatch + 4.0 + text_width(series.label, size);
    if (any && x + width > place.right()) {
      x = place.left;
      y -= key_height;
    }
    any = true;
    draw_swatch(paper, {x, y + 2.5}, swatch, series);
    paper.text(series.label, {x + swatch + 4.0, y}, {.size = size});
    x += width + column_gap;
  }
  const double used = any ? place.top() - y + 2.0 : 0.0;
  return {place.left, place.bottom, place.width, place.height - used};
}

double table_height(const Table& table, double width) {
  const std::vector<double> widths = column_widths(table, width);
  double height = caption_of(table.caption) + (table.has_header ? 2.0 : 0.0);
  for (const auto& row : table.rows) height += line_height * static_cast<double>(lines_of(row, widths));
  return height;
}

void draw_table(Paper& paper, const Rectangle& place, const Table& table) {
  const Rectangle body = below_caption(paper, place, table.caption);
  const std::vector<double> widths = column_widths(table, body.width);
  const double size = table_size(table, widths);
  double y = body.top();
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<std::string>& row = table.rows[r];
    const bool header = table.has_header && r == 0;
    double x = body.left;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Colour colour = header || (i == 0 && !table.has_header) ? grey : Colour{};
      const bool last = i + 1 == widths.size();
      double line = y + 2.5;
      for (const std::string& part : last ? broken(row[i], text_size, widths[i]) : std::vector{row[i]})
        paper.text(part, {x, line -= line_height},
                   {.size = std::min(size, fitting_size(part, text_size, widths[i])), .colour = colour});
      x += widths[i] + column_gap;
    }
    y -= line_height * static_cast<double>(lines_of(row, widths));
    if (!header) continue;
    y -= 2.0;
    paper.stroke(std::vector<PaperPoint>{{body.left, y + 1.0}, {x - column_gap, y + 1.0}}, {grey, 0.4});
  }
}

double text_height(const TextBlock& text, double width) {
  return caption_of(text.caption) + line_height * static_cast<double>(broken_lines(text, width).size());
}

void draw_text(Paper& paper, const Rectangle& place, const TextBlock& text) {
  const Rectangle body = below_caption(paper, place, text.caption);
  double y = body.top();
  for (const std::string& line : broken_lines(text, body.width))
    paper.text(line, {body.left, (y -= line_height) + 2.5}, {.size = text_size});
}

}  // namespace pfdm
