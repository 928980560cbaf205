#include "postproc/page/picture_drawing.h"

#include "postproc/page/chart_ticks.h"
#include "postproc/page/lettering.h"
#include "postproc/page/page_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double label_size = 7.0, title_size = 7.5, tick = 2.5;                // [pt]
constexpr double room_left = 34.0, room_below = 25.0, room_for_colours = 42.0;  // [pt]

struct ColourPoint {
  double value;  // 0 to 1
  Colour colour;
};
/// From pale blue-grey to dark red, as damage is shown in the cases' pictures.
constexpr std::array<ColourPoint, 5> colours{{{0.0, {0.93, 0.94, 0.96}},
                                              {0.25, {0.62, 0.76, 0.88}},
                                              {0.5, {0.99, 0.85, 0.45}},
                                              {0.75, {0.91, 0.37, 0.20}},
                                              {1.0, {0.40, 0.00, 0.10}}}};

Colour colour_at(double part) {
  part = std::clamp(part, 0.0, 1.0);
  std::size_t i = 1;
  while (i + 1 < colours.size() && part > colours[i].value) ++i;
  const ColourPoint &a = colours[i - 1], &b = colours[i];
  const double s = (part - a.value) / (b.value - a.value);
  const auto mix = [s](double from, double to) { return from + s * (to - from); };
  return {mix(a.colour.red, b.colour.red), mix(a.colour.green, b.colour.green), mix(a.colour.blue, b.colour.blue)};
}

/// Where the picture's coordinates come to lie: one scale for both directions.
struct Frame {
  Rectangle window;
  Eigen::Vector2d lower, upper;
  PaperPoint at(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d part = (p - lower).cwiseQuotient(upper - lower);
    return {window.left + part.x() * window.width, window.bottom + part.y() * window.height};
  }
};

Frame frame_for(const Rectangle& place, const Picture& picture) {
  Frame frame{.window = {}, .lower = Eigen::Vector2d::Constant(1e300), .upper = Eigen::Vector2d::Constant(-1e300)};
  for (const Picture::Cell& cell : picture.cells)
    for (const Eigen::Vector2d& p : cell.corners) {
      frame.lower = frame.lower.cwiseMin(p);
      frame.upper = frame.upper.cwiseMax(p);
    }
  if (picture.cells.empty()) frame.lower = {0.0, 0.0}, frame.upper = {1.0, 1.0};
  const Eigen::Vector2d extent = frame.upper - frame.lower;
  const double width = place.width - room_left - room_for_colours, height = place.height - room_below - 4.0;
  const double scale = std::min(width / extent.x(), height / extent.y());
  frame.window = {place.left + room_left, place.top() - 4.0 - scale * extent.y(), scale * extent.x(),
                  scale * extent.y()};
  return frame;
}

void draw_axes(Paper& paper, const Frame& frame, const Picture& picture) {
  const Rectangle& w = frame.window;
  const AxisTicks x = axis_ticks({.title = {}, .from = frame.lower.x(), .to = frame.upper.x()}, 0.0, 0.0,
                                 std::max(2, static_cast<int>(w.width / 40.0)));
  for (std::size_t i = 0; i < x.positions.size(); ++i) {
    const double at = frame.at({x.positions[i], frame.lower.y()}).x();
    paper.stroke(std::vector<PaperPoint>{{at, w.bottom}, {at, w.bottom - tick}}, {});
    paper.text(x.labels[i], {at - 0.5 * text_width(x.labels[i], label_size), w.bottom - tick - 7.0},
               {.size = label_size});
  }
  const AxisTicks y = axis_ticks({.title = {}, .from = frame.lower.y(), .to = frame.upper.y()}, 0.0, 0.0,
                                 std::max(2, static_cast<int>(w.height / 25.0)));
  double widest = 0.0;
  for (std::size_t i = 0; i < y.positions.size(); ++i) {
    const double at = frame.at({frame.lower.x(), y.positions[i]}).y(), width = text_width(y.labels[i], label_size);
    paper.stroke(std::vector<PaperPoint>{{w.left, at}, {w.left - tick, at}}, {});
    paper.text(y.labels[i], {w.left - tick - 2.0 - width, at - 2.5}, {.size = label_size});
    widest = std::max(widest, width);
  }
  paper.text(picture.x_title, {w.left + 0.5 * (w.width - text_width(picture.x_title, title_size)), w.bottom - 19.0},
             {.size = title_size});
  paper.text(picture.y_title,
             {w.left - tick - widest - 6.0, w.bottom + 0.5 * (w.height - text_width(picture.y_title, title_size))},
             {.size = title_size, .angle = 0.5 * std::numbers::pi});
}

void draw_colours(Paper& paper, const Frame& frame, const Picture& picture) {
  constexpr int steps = 64;
  const Rectangle bar{frame.window.right() + 8.0, frame.window.bottom, 7.0, frame.window.height};
  for (int i = 0; i < steps; ++i) {
    const double y0 = bar.bottom + bar.height * i / steps, y1 = bar.bottom + bar.height * (i + 1) / steps;
    paper.fill(std::array<PaperPoint, 4>{{{bar.left, y0}, {bar.right(), y0}, {bar.right(), y1}, {bar.left, y1}}},
               colour_at((i + 0.5) / steps));
  }
  const AxisTicks ticks = axis_ticks({.title = {}, .from = picture.least, .to = picture.most}, 0.0, 0.0,
                                     std::max(1, static_cast<int>(bar.height / 20.0)));
  for (std::size_t i = 0; i < ticks.positions.size(); ++i) {
    const double y = bar.bottom + bar.height * (ticks.positions[i] - picture.least) / (picture.most - picture.least);
    paper.text(ticks.labels[i], {bar.right() + 3.0, y - 2.5}, {.size = label_size});
  }
  paper.text(picture.value_title,
             {bar.right() + 25.0, bar.bottom + 0.5 * (bar.height - text_width(picture.value_title, title_size))},
             {.size = title_size, .angle = 0.5 * std::numbers::pi});
}

}  // namespace

void draw_picture(Paper& paper, const Rectangle& place, const Picture& picture) {
  const Frame frame = frame_for(below_caption(paper, place, picture.caption), picture);
  const auto on_paper = [&](const std::vector<Eigen::Vector2d>& points) {
    std::vector<PaperPoint> result;
    result.reserve(points.size());
    for (const Eigen::Vector2d& p : points) result.push_back(frame.at(p));
    return result;
  };
  for (const Picture::Cell& cell : picture.cells)
    paper.fill(on_paper(cell.corners), colour_at((cell.value - picture.least) / (picture.most - picture.least)));
  for (const auto& line : picture.lines) paper.stroke(on_paper(line), {.colour = {}, .width = 0.6});
  draw_axes(paper, frame, picture);
  draw_colours(paper, frame, picture);
}

}  // namespace pfdm
