#include "postproc/page/chart_drawing.h"

#include "postproc/page/axes_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double curve_width = 0.9, point_width = 2.2;  // [pt]

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void take(double value, bool positive) {
    if (!std::isfinite(value) || (positive && value <= 0.0)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

Axes axes_for(const Rectangle& place, const Chart& chart) {
  constexpr double room_above = 5.0, room_right = 8.0;  // [pt]
  Range x, y;
  for (const Series& series : chart.series)
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      x.take(series.x[i], chart.x.logarithmic);
      y.take(series.y[i], chart.y.logarithmic);
      if (series.style == SeriesStyle::band) y.take(series.upper[i], chart.y.logarithmic);
    }
  Axes axes{.window = {},
            .x = axis_ticks(chart.x, x.least, x.most, std::max(2, static_cast<int>(place.width / 45.0))),
            .y = axis_ticks(chart.y, y.least, y.most, std::max(2, static_cast<int>(place.height / 25.0))),
            .x_title = chart.x.title,
            .y_title = chart.y.title};
  const double room_left = room_left_of(axes.y);
  axes.window = {place.left + room_left, place.bottom + room_below_axes, place.width - room_left - room_right,
                 place.height - room_below_axes - room_above};
  return axes;
}

/// A part of a series without interruption.
struct Piece {
  std::vector<PaperPoint> line, upper;
};

std::vector<Piece> pieces_of(const Series& series, const Chart& chart, const Axes& axes) {
  const auto along = [](double value, const ChartAxis& axis) { return axis.logarithmic ? std::log10(value) : value; };
  const bool band = series.style == SeriesStyle::band;
  std::vector<Piece> pieces;
  bool open = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double x = along(series.x[i], chart.x), y = along(series.y[i], chart.y);
    const double upper = band ? along(series.upper[i], chart.y) : y;
    const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(upper);
    if (finite && !open) pieces.emplace_back();
    open = finite;
    if (!finite) continue;
    pieces.back().line.push_back(axes.at(x, y));
    if (band) pieces.back().upper.push_back(axes.at(x, upper));
  }
  return pieces;
}

/// Between two gaps a single point makes no line and no band.
void draw_piece(Paper& paper, const Piece& piece, const Series& series) {
  if (has_dots(series))
    for (const PaperPoint& point : piece.line) paper.stroke({&point, 1}, {series_colour(series.colour), point_width});
  if (piece.line.size() < 2) return;
  if (has_line(series)) paper.stroke(piece.line, series_pen(series, curve_width));
  if (series.style != SeriesStyle::band) return;
  std::vector<PaperPoint> polygon = piece.line;
  polygon.insert(polygon.end(), piece.upper.rbegin(), piece.upper.rend());
  paper.fill(polygon, series_colour(series.colour));
}

}  // namespace

Colour series_colour(int number) {
  // Okabe and Ito's colours for all kinds of colour vision, then greys for bands.
  static constexpr std::array<Colour, 8> colours{{{0.0, 0.0, 0.0},
                                                  {0.0, 0.447, 0.698},
                                                  {0.835, 0.369, 0.0},
                                                  {0.0, 0.62, 0.451},
                                                  {0.8, 0.475, 0.655},
                                                  {0.902, 0.624, 0.0},
                                                  {0.337, 0.706, 0.914},
                                                  {0.83, 0.83, 0.83}}};
  return colours[static_cast<std::size_t>(number) % colours.size()];
}

Pen series_pen(const Series& series, double width) {
  const std::vector<double> dashes =
      series.style == SeriesStyle::dashed ? std::vector{4.0, 2.0} : std::vector<double>{};
  return {series_colour(series.colour), width, dashes};
}

bool has_line(const Series& series) { return series.style != SeriesStyle::points && series.style != SeriesStyle::band; }

bool has_dots(const Series& series) {
  return series.style == SeriesStyle::points || series.style == SeriesStyle::line_with_points;
}

void draw_chart(Paper& paper, const Rectangle& place, const Chart& chart) {
  const Axes axes = axes_for(place, chart);
  draw_grid(paper, axes);
  paper.clip(axes.window);
  for (const Series& series : chart.series)
    for (const Piece& piece : pieces_of(series, chart, axes)) draw_piece(paper, piece, series);
  paper.clip(std::nullopt);
  draw_axes(paper, axes);
}

}  // namespace pfdm
